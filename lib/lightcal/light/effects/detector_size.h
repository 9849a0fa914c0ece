// SPDX-License-Identifier: Apache-2.0
// A meter's head so large that the light falls on its rim at an angle.
#pragma once

#include <cmath>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

inline constexpr double kHeadRadiusDefault = 0.01;

// Mean illuminance over a disk of radius rho facing a point at distance d, over that at its centre:
//   2/y (1 - (1 + y)^(-1/2)),  y = (rho/d)^2   ->  1 - 3/4 y
[[nodiscard]] inline double DetectorFactor(double head_radius_m, double distance_m) {
  const double y = (head_radius_m / distance_m) * (head_radius_m / distance_m);
  if (y < 1e-12) return 1.0 - 0.75 * y;
  return -2.0 / y * std::expm1(-0.5 * std::log1p(y));
}

//   bound = 3/4 (rho/d)^2 at the nearest reading.
[[nodiscard]] inline EffectFinding FindDetectorSize(const Scene& scene) {
  if (!FollowsDistance(scene)) return NotApplicable("no distance law");
  const double radius = scene.head_radius ? scene.head_radius->value() : kHeadRadiusDefault;
  const double ratio = radius / NearestDistance(scene);
  return {0.75 * ratio * ratio, scene.head_radius ? Treatment::kModelled : Treatment::kWidens, 0.0,
          scene.head_radius ? "the meter's stated head" : "a head of 1 cm radius is assumed"};
}

}  // namespace lightcal::effects
