// SPDX-License-Identifier: Apache-2.0
// Distances read wrongly, all by the same amount.
#pragma once

#include <algorithm>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// A tape measure held by hand.
inline constexpr double kDistanceErrorMetres = 0.005;

//   bound = 1/(1 - u/d)^2 - 1, u = 5 mm, d the nearest distance. A common error of distance is a
//   distance offset, which is fitted.
[[nodiscard]] inline EffectFinding FindDistanceError(const Scene& scene) {
  if (!FollowsDistance(scene)) return NotApplicable("no distance law");
  const double left = 1.0 - std::min(0.9, kDistanceErrorMetres / NearestDistance(scene));
  return {1.0 / (left * left) - 1.0, Treatment::kFitted, 0.0,
          "5 mm at the nearest distance; the distance offset takes up the common part"};
}

}  // namespace lightcal::effects
