// SPDX-License-Identifier: Apache-2.0
// A source partly below the meter's own horizon.
#pragma once

#include <cmath>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// A test, not a bound: some of a ball lies behind the meter as soon as its radius reaches
// d cos(tilt); of a flat source that faces the meter, or a tube across, as soon as
// radius sin(tilt) does: facing it squarely the meter sees all of a softbox, however near. Then up
// to all of its light is cut off.
[[nodiscard]] inline EffectFinding FindHorizon(const Scene& scene) {
  const std::optional<double> radius = SourceRadius(scene);
  if (!FollowsDistance(scene)) return NotApplicable("no distance law");
  if (!radius) return {0.0, Treatment::kModelled, 0.0, "a point is above the horizon or below it"};
  const bool ball = scene.kind == LightKind::kSphere;
  bool cut = false;
  bool placed = true;
  for (const ScenePose& pose : scene.poses) {
    const double behind = ball ? *radius : *radius * std::abs(std::sin(pose.tilt_rad));
    if (behind < pose.distance_m * std::cos(pose.tilt_rad)) continue;
    cut = true;
    placed = placed && pose.position_m.has_value();
  }
  if (!cut) return {0.0, Treatment::kModelled, 0.0, "the whole source is above every horizon"};
  if (placed) return {1.0, Treatment::kModelled, 0.0, "the exact source is clipped there"};
  return {1.0, Treatment::kWidens, 0.0,
          "part of the source lies behind the meter: give position_m and normal, or turn it"};
}

}  // namespace lightcal::effects
