// SPDX-License-Identifier: Apache-2.0
// Light lost in the air.
#pragma once

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// Extinction of clear air, per metre (visibility 20 km); stage haze has 0.01 to 0.05.
inline constexpr double kClearAirPerMetre = 2e-4;

//   E = I exp(-s d)/d^2,   bound = s d at the farthest reading.
[[nodiscard]] inline EffectFinding FindHaze(const Scene& scene) {
  if (!FollowsDistance(scene)) return {0.0, Treatment::kWidens, 0.0, "no distance law"};
  return {kClearAirPerMetre * FarthestDistance(scene), Treatment::kWidens, 1.0,
          "clear air; stage haze would take fifty times as much"};
}

}  // namespace lightcal::effects
