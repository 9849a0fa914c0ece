// SPDX-License-Identifier: Apache-2.0
// Colour filters as their makers tabulate them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/result.h"

namespace lightcal {

// What a maker prints of a filter under one of its lights: Y in percent of the unfiltered light's.
struct GelClaim {
  double y_percent = 0.0;
  Xy xy;
};

// Transmittance in 0..1 at strictly increasing wavelengths, two or more.
struct Gel {
  std::string id;    // "L204"; its name where the file gives no number
  std::string name;  // "Full C.T. Orange"; may be empty
  std::vector<double> wavelengths_nm, transmittance;
  std::optional<GelClaim> tungsten{}, daylight{};  // as the file claims, for comparisons
};

struct GelSet {
  std::string source;          // the file, or what these are
  bool demonstration = false;  // analytic filters that nobody makes
  std::vector<Gel> gels;
  Warnings warnings{};  // gels_as_fractions
};

// "L204 Full C.T. Orange", or the id alone.
[[nodiscard]] std::string GelTitle(const Gel& gel);

// The gel a person means by "L204", "204", "full cto", "1/2 CTB" or "minus green": its id, the
// number in it, its name without signs, a trade's short name (CTO, CTB, ND, 1/2, 1/4, 1/8 written
// out), or the one gel whose name holds every word of it. Refused: unknown_gel (says the nearest
// names), ambiguous_gel (lists what it may mean).
[[nodiscard]] Result<std::size_t> FindGel(const GelSet& set, std::string_view words);

// Why this is no gel (lengths, order, values outside 0..1); empty where it is one.
[[nodiscard]] std::string FaultOf(const Gel& gel);

}  // namespace lightcal
