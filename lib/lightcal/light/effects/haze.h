// SPDX-License-Identifier: Apache-2.0
// Light lost in the air.
#pragma once

#include <cmath>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// Extinction of clear air, per metre (visibility 20 km); stage haze has 0.01 to 0.05.
inline constexpr double kClearAirPerMetre = 2e-4;

// What is left of light after d in air of extinction s, over what clear air leaves: exp(-s d).
[[nodiscard]] inline double HazeFactor(double extinction_per_m, double distance_m) {
  return std::exp(-extinction_per_m * distance_m);
}

//   E = I exp(-s d)/d^2,   bound = 1 - exp(-s d) at the farthest reading.
[[nodiscard]] inline EffectFinding FindHaze(const Scene& scene) {
  if (!FollowsDistance(scene)) return NotApplicable("no distance law");
  const double extinction = scene.time.haze_per_metre.value_or(kClearAirPerMetre);
  return {-std::expm1(-extinction * FarthestDistance(scene)),
          scene.time.haze_per_metre ? Treatment::kModelled : Treatment::kWidens, 1.0,
          scene.time.haze_per_metre ? "the stated extinction of the air"
                                    : "clear air; stage haze would take fifty times as much"};
}

}  // namespace lightcal::effects
