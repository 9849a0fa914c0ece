// SPDX-License-Identifier: Apache-2.0
// A source partly below the meter's own horizon.
#pragma once

#include <cmath>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// A test, not a bound: some of the source lies behind the meter as soon as its radius reaches
// d cos(tilt); then up to all of its light is cut off.
[[nodiscard]] inline EffectFinding FindHorizon(const Scene& scene) {
  const std::optional<double> radius = SourceRadius(scene);
  if (!FollowsDistance(scene)) return NotApplicable("no distance law");
  if (!radius) return {0.0, Treatment::kModelled, 0.0, "a point is above the horizon or below it"};
  bool cut = false;
  bool placed = true;
  for (const ScenePose& pose : scene.poses) {
    if (*radius < pose.distance_m * std::cos(pose.tilt_rad)) continue;
    cut = true;
    placed = placed && pose.position_m.has_value();
  }
  if (!cut) return {0.0, Treatment::kModelled, 0.0, "the whole source is above every horizon"};
  if (placed) return {1.0, Treatment::kModelled, 0.0, "the exact source is clipped there"};
  return {1.0, Treatment::kWidens, 0.0,
          "part of the source lies behind the meter: give position_m and normal, or turn it"};
}

}  // namespace lightcal::effects
