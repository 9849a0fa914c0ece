// SPDX-License-Identifier: Apache-2.0
// A source too large for the inverse-square law at the distances used.
#pragma once

#include <cmath>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// Radius of a lamp whose size is not given: a bulb.
inline constexpr double kRadiusDefault = 0.03;

//   bound = |g(d)/1 - 1|^-1 form: |1/g - 1| with g the exact axial factor of axial_shape.h at the
//   nearest reading (disk: (R/d)^2). A sphere has none: it is exactly inverse-square to its centre.
[[nodiscard]] inline EffectFinding FindFiniteSource(const Scene& scene) {
  if (!FollowsDistance(scene)) return {0.0, Treatment::kModelled, 0.0, "no distance law"};
  if (scene.kind == LightKind::kSphere) {
    return {0.0, Treatment::kModelled, 0.0,
            "a sphere follows the inverse-square law exactly, to its centre"};
  }
  const AxialShape shape = AxialShapeOf(scene.kind, scene.size);
  const double nearest = NearestDistance(scene);
  if (shape.outline != AxialShape::Outline::kPoint) {
    return {1.0 / AxialShapeFactor(shape, nearest) - 1.0, Treatment::kModelled, 0.0,
            "its size against the nearest distance, exact form on the axis"};
  }
  const double ratio = kRadiusDefault / nearest;
  return {ratio * ratio, Treatment::kFitted, 0.0,
          "no size given; a 6 cm lamp is assumed, and the distance offset takes up the rest"};
}

}  // namespace lightcal::effects
