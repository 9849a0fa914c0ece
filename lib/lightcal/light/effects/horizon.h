// SPDX-License-Identifier: Apache-2.0
// A source partly below the meter's own horizon.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "lightcal/light/effects/effect.h"
#include "lightcal/light/models/body_of.h"

namespace lightcal::effects {

// The largest |E/(E0 cos t) - 1| over all directions in which a meter on the axis can be tilted by
// t, E by the exact form that the meter's plane cuts, E0 facing: without a cut E follows the cosine
// whatever the source.
[[nodiscard]] inline double CutByTilt(const SourceModel& source, const ScenePose& pose) {
  constexpr int kWays = 24;
  const double s = std::sin(pose.tilt_rad), c = std::cos(pose.tilt_rad);
  const Vec3 at = {0.0, 0.0, pose.distance_m};
  const double facing = LuxPerCandela(source, Receiver<double>{at, {0.0, 0.0, -1.0}});
  double most = 0.0;
  for (int i = 0; i < kWays; ++i) {
    const double way = 2.0 * std::numbers::pi * i / kWays;
    const Vec3 normal = {s * std::cos(way), s * std::sin(way), -c};
    const double seen = LuxPerCandela(source, Receiver<double>{at, normal});
    most = std::max(most, std::abs(seen / (facing * c) - 1.0));
  }
  return most;
}

// Some of a ball lies behind the meter as soon as its radius reaches d cos(tilt); of a flat source
// that faces the meter, or a tube across, as soon as radius sin(tilt) does: facing it squarely the
// meter sees all of a softbox, however near. Then bound = CutByTilt, up to all of its light.
[[nodiscard]] inline EffectFinding FindHorizon(const Scene& scene) {
  const std::optional<double> radius = SourceRadius(scene);
  if (!FollowsDistance(scene)) return NotApplicable("no distance law");
  if (!radius) return {0.0, Treatment::kModelled, 0.0, "a point is above the horizon or below it"};
  const bool ball = scene.kind == LightKind::kSphere;
  const std::optional<SourceModel> body = BodyOf(scene.kind, scene.size);
  bool cut = false;
  bool placed = true;
  double bound = 0.0;
  for (const ScenePose& pose : scene.poses) {
    const double behind = ball ? *radius : *radius * std::abs(std::sin(pose.tilt_rad));
    if (behind < pose.distance_m * std::cos(pose.tilt_rad)) continue;
    cut = true;
    placed = placed && pose.position_m.has_value();
    bound = std::max(bound, body && !ball ? std::min(1.0, CutByTilt(*body, pose)) : 1.0);
  }
  if (!cut) return {0.0, Treatment::kModelled, 0.0, "the whole source is above every horizon"};
  if (placed) return {1.0, Treatment::kModelled, 0.0, "the exact source is clipped there"};
  return {bound, Treatment::kWidens, 0.0,
          "part of the source lies behind the meter: give position_m and normal, or turn it"};
}

}  // namespace lightcal::effects
