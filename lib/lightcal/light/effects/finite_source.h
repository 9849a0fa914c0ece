// SPDX-License-Identifier: Apache-2.0
// A source too large for the inverse-square law at the distances used.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// Radius of a lamp whose size is not given: a bulb.
inline constexpr double kRadiusDefault = 0.03;
// Poses nearer to the axis than this count as on it.
inline constexpr double kOnAxis_rad = 1e-3;

// Second moments of the outline along its two axes over its area [m^2], and the largest squared
// half diagonal of a box around it.
struct OutlineMoments {
  std::array<double, 2> along{};
  double box = 0.0;
};
[[nodiscard]] inline OutlineMoments MomentsOf(const AxialShape& shape) {
  const double a = shape.first * shape.first;
  const double b = shape.second * shape.second;
  switch (shape.outline) {
    case AxialShape::Outline::kPoint:
      break;
    case AxialShape::Outline::kDisk:
      return {{0.25 * a, 0.25 * a}, 2.0 * a};
    case AxialShape::Outline::kRect:
      return {{a / 3.0, b / 3.0}, a + b};
    case AxialShape::Outline::kTube:
      return {{a / 3.0, 0.0}, a};
  }
  return {};
}

// |true/point - 1| of a Lambertian outline seen `emission` off its axis, turned anyhow about it:
// the second moments' part, and 1.35 (1 + 1/cos tilt) x^2, x = (half diagonal/d)^2, for the rest.
[[nodiscard]] inline double OffAxisSizeBound(const OutlineMoments& moments, const ScenePose& pose) {
  const double d2 = pose.distance_m * pose.distance_m;
  const double s = std::sin(pose.emission_rad);
  const auto [m1, m2] = moments.along;
  const double along_first = -2.0 * (m1 + m2) + 8.0 * s * s * m1;
  const double along_second = -2.0 * (m1 + m2) + 8.0 * s * s * m2;
  const double tilt = 4.0 * std::numbers::sqrt2 * std::tan(pose.tilt_rad) * s * std::max(m1, m2);
  const double x = moments.box / d2;
  const double rest = 1.35 * (1.0 + 1.0 / std::cos(pose.tilt_rad)) * x * x;
  return (std::max(std::abs(along_first), std::abs(along_second)) + tilt) / d2 + rest;
}

//   bound = 1/g(d) - 1 on the axis, g the exact axial factor of axial_shape.h (disk: (R/d)^2), off
//   it as OffAxisSizeBound; the largest of the readings. A sphere has none: it is exactly
//   inverse-square to its centre.
[[nodiscard]] inline EffectFinding FindFiniteSource(const Scene& scene) {
  if (!FollowsDistance(scene)) return NotApplicable("no distance law");
  if (scene.kind == LightKind::kSphere) {
    return {0.0, Treatment::kModelled, 0.0,
            "a sphere follows the inverse-square law exactly, to its centre"};
  }
  const AxialShape shape = AxialShapeOf(scene.kind, scene.size);
  const bool a_panel =
      !scene.makes.empty() &&
      std::ranges::all_of(scene.makes, [](const auto& one) { return one.width_m > 0.0; });
  if (shape.outline == AxialShape::Outline::kPoint && a_panel) {
    double bound = 0.0;
    for (const LampMake& one : scene.makes) {
      SourceSize size;
      size.width = Metres(one.width_m);
      size.height = Metres(one.height_m);
      const AxialShape panel = AxialShapeOf(LightKind::kRect, size);
      bound = std::max(bound, 1.0 / AxialShapeFactor(panel, NearestDistance(scene)) - 1.0);
    }
    return {bound, Treatment::kFitted, 0.0,
            "no size given; a panel of 10 to 50 cm is weighed by what the readings say of it"};
  }
  if (shape.outline == AxialShape::Outline::kPoint) {
    const double ratio = kRadiusDefault / NearestDistance(scene);
    return {ratio * ratio, Treatment::kFitted, 0.0,
            "no size given; a 6 cm lamp is assumed, and the distance offset takes up the rest"};
  }
  const OutlineMoments moments = MomentsOf(shape);
  double bound = 0.0;
  for (const ScenePose& pose : scene.poses) {
    bound = std::max(bound, pose.emission_rad > kOnAxis_rad
                                ? OffAxisSizeBound(moments, pose)
                                : 1.0 / AxialShapeFactor(shape, pose.distance_m) - 1.0);
  }
  return {bound, Treatment::kModelled, 0.0,
          LargestEmission(scene) > kOnAxis_rad
              ? "its size against the distances, where the readings stand off its axis"
              : "its size against the nearest distance, exact form on the axis"};
}

}  // namespace lightcal::effects
