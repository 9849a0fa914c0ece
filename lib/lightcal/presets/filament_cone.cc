// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/filament_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightcal {

double FilamentCosine(Radians angle) {
  const double z = angle.value() / (2.0 * std::numbers::pi) - 0.25;
  const double y = z * (16.0 * std::abs(z) - 8.0);
  return y + 0.225 * y * (std::abs(y) - 1.0);
}

Radians AngleForFilament(Radians angle) {
  constexpr double kQuarterTurnAngle = std::numbers::pi / 2.0;
  constexpr int kHalvings = 60;
  const double cosine = std::cos(std::clamp(angle.value(), 0.0, kQuarterTurnAngle));
  // It falls all the way.
  double low = 0.0, high = kQuarterTurnAngle;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (FilamentCosine(Radians(middle)) > cosine ? low : high) = middle;
  }
  return Radians(0.5 * (low + high));
}

}  // namespace lightcal
