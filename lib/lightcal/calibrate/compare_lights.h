// SPDX-License-Identifier: Apache-2.0
// Whether lamps changed between two calibrations, by more than both are unsure of.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/records/fitted_light.h"

namespace lightcal {

enum class Change : std::uint8_t {
  kSame,      // to the last digit that is kept
  kWithin,    // |difference| <= u
  kChanged,   // |difference| > u
  kWithoutU,  // differs, and neither side says how sure it is
};

// One number of a light before and after. Distances (position, chromaticity, aim) have no two
// values, only a difference.
struct QuantityChange {
  std::string quantity;  // a key of light.json: "intensity_cd", "color.cct_K"
  std::string unit;      // "cd"
  bool has_values = true;
  Uncertain before, after;
  double difference = 0.0;  // after - before
  double u95 = 0.0;         // of the difference
  Change change = Change::kSame;
};

struct LightChange {
  std::string name;                  // before; of a pair with two names "key -> key2"
  bool before = true, after = true;  // which calibration has it
  bool kind_changed = false;
  std::string common_meter;  // whose error is in both and so in no difference of light, "" = none
  std::vector<QuantityChange> quantities;

  [[nodiscard]] bool Changed() const;
};

struct LightComparison {
  std::vector<LightChange> lights;         // in the first file's order, then what only b has
  std::vector<std::string> shared_inputs;  // files of one content that both were made from
  bool same_inputs = false;                // all of them

  [[nodiscard]] bool Changed() const;
};

// Lights are paired by name (a single light with a single light, whatever their names). For values
// with 95 % half widths ua and ub, of asymmetric intervals those of the sides that face each other,
//   u = sqrt(ua^2 + ub^2 - 2 r ua ub),     r the correlation of their errors, 0 = independent
// is the 95 % half width of the difference of normal errors: of lamps that did not change, 1
// quantity in 20 exceeds it. Where no r is given and one meter (by its name) read both sides, its
// calibration c is common to what they say of light,
//   u = sqrt(ua^2 + ub^2 - 2 pa pb),       p = min(u, 1.96 c value)
// and all else independent. u is never below a thousandth of ua or ub, which is how exactly a fit
// ends. A position's three coordinates are judged together, by
// 2.795/1.960 times the u along the difference (chi-square with three degrees of freedom).
[[nodiscard]] LightComparison CompareLights(const LightFile& a, const LightFile& b,
                                            std::optional<double> correlation);

}  // namespace lightcal
