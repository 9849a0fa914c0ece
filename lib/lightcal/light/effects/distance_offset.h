// SPDX-License-Identifier: Apache-2.0
// The effective source lies behind or before the point that distances are measured from.
#pragma once

#include <algorithm>
#include <cmath>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

//   E = I/(d + d0)^2,   bound = 1/(1 - |d0|/d)^2 - 1 at the nearest reading, |d0| what 19 of 20
//   such lamps stay within (light/fixture.h); 0.15 d where nothing says what the lamp is.
[[nodiscard]] inline EffectFinding FindDistanceOffset(const Scene& scene) {
  if (!FollowsDistance(scene)) return NotApplicable("no distance law");
  double relative = 0.15;
  if (!scene.offsets.empty()) {
    double most = 0.0;
    for (const OffsetPart& part : scene.offsets) {
      most = std::max(most, std::abs(part.mean_m) + 1.96 * part.sd_m);
    }
    relative = std::min(0.9, most / NearestDistance(scene));
  }
  return {1.0 / ((1.0 - relative) * (1.0 - relative)) - 1.0, Treatment::kFitted, 0.0,
          scene.distances >= 2
              ? "fitted from " + std::to_string(scene.distances) + " distances and its prior"
              : "one distance cannot tell it; its prior widens the interval"};
}

}  // namespace lightcal::effects
