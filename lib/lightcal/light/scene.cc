// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lightcal/light/intensity_table.h"

namespace lightcal {

SceneTable SceneTableOf(const IntensityTable& table) {
  const IntensityGrid& grid = table.grid();
  const std::size_t nodes = grid.vertical_deg.size();
  SceneTable out;
  for (std::size_t i = 1; i < nodes; ++i) {
    const double step = grid.vertical_deg[i] - grid.vertical_deg[i - 1];
    out.step_rad = std::max(out.step_rad, RadiansFromDegrees(step).value());
  }
  for (std::size_t plane = 0; plane < grid.horizontal_deg.size(); ++plane) {
    const double* candela = grid.candela.data() + plane * nodes;
    for (std::size_t i = 1; i + 1 < nodes; ++i) {
      const double second = candela[i - 1] - 2.0 * candela[i] + candela[i + 1];
      out.second_difference = std::max(out.second_difference, std::abs(second));
    }
  }
  out.second_difference /= table.peak().intensity.value();
  return out;
}

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
