// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightcal {

double NearestDistance(const Scene& scene) {
  double nearest = std::numeric_limits<double>::max();
  for (const ScenePose& pose : scene.poses) nearest = std::min(nearest, pose.distance_m);
  return nearest;
}

double FarthestDistance(const Scene& scene) {
  double farthest = 0.0;
  for (const ScenePose& pose : scene.poses) farthest = std::max(farthest, pose.distance_m);
  return farthest;
}

double LargestTilt(const Scene& scene) {
  double tilt = 0.0;
  for (const ScenePose& pose : scene.poses) tilt = std::max(tilt, std::abs(pose.tilt_rad));
  return tilt;
}

double LargestEmission(const Scene& scene) {
  double emission = 0.0;
  for (const ScenePose& pose : scene.poses) emission = std::max(emission, pose.emission_rad);
  return emission;
}

bool FollowsDistance(const Scene& scene) {
  return scene.kind != LightKind::kDirectional && scene.kind != LightKind::kDome;
}

std::optional<double> SourceRadius(const Scene& scene) {
  const SourceSize& size = scene.size;
  if (size.diameter) return 0.5 * size.diameter->value();
  if (size.width && size.height) return 0.5 * std::max(size.width->value(), size.height->value());
  if (size.length) return 0.5 * size.length->value();
  return std::nullopt;
}

}  // namespace lightcal
