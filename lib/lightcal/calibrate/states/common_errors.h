// SPDX-License-Identifier: Apache-2.0
// What the errors of several lights have in common, and what is left of it in their difference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "lightcal/calibrate/states/match_states.h"
#include "lightcal/colorimetry/cct.h"

namespace lightcal {

// A point's errors, independent of one another, 1 sigma:
//   sd^2 = own^2 + lamp^2 + meter^2
// own is one lamp's at one state, lamp a lamp's at all of its states, meter one instrument's in all
// that it read.
struct ErrorParts {
  LightErrors own, lamp, meter;
  double meter_xy = 0.0;  // meter's of colour, in x and in y
  CctResult cct;          // that ln mired and Duv are of
};
[[nodiscard]] ErrorParts PartsOf(const LightPoint& point);

// 1 sigma of what a and b differ by.
[[nodiscard]] LightErrors ErrorsApart(const LightPoint& a, const LightPoint& b);
// Whether one instrument's error is in both, and so not in their difference.
[[nodiscard]] bool ColorErrorCancels(const LightPoint& a, const LightPoint& b);
[[nodiscard]] bool LevelErrorCancels(const LightPoint& a, const LightPoint& b);

// Draws of several points at once: errors of one source are one number.
class DrawnPoints {
 public:
  DrawnPoints(std::vector<LightPoint> points, std::uint64_t seed);
  [[nodiscard]] std::vector<LightPoint> Next();

 private:
  // Which of the sources each part is of.
  struct Sources {
    std::size_t own = 0, lamp = 0, color_meter = 0, level_meter = 0;
  };
  std::vector<LightPoint> points_;
  std::vector<ErrorParts> parts_;
  std::vector<Sources> sources_;
  std::size_t count_ = 0;
  std::mt19937_64 random_;
};

}  // namespace lightcal
