// SPDX-License-Identifier: Apache-2.0
// The effective source lies behind or before the point that distances are measured from.
#pragma once

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

//   E = I/(d + d0)^2,   bound = 1/(1 - |d0|/d)^2 - 1 at |d0| = 0.15 d, the prior's standard
//   deviation.
[[nodiscard]] inline EffectFinding FindDistanceOffset(const Scene& scene) {
  if (!FollowsDistance(scene)) return NotApplicable("no distance law");
  constexpr double kRelative = 0.15;
  return {
      1.0 / ((1.0 - kRelative) * (1.0 - kRelative)) - 1.0, Treatment::kFitted, 0.0,
      scene.distances >= 2
          ? "fitted from " + std::to_string(scene.distances) + " distances and its prior"
          : "one distance cannot tell it; its prior of 15 % of the distance widens the interval"};
}

}  // namespace lightcal::effects
