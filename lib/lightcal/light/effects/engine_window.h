// SPDX-License-Identifier: Apache-2.0
// An engine's range, which fades a light towards its end.
#pragma once

#include <algorithm>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

//   bound = 1 - (1 - (d/r)^4)^2 (glTF: (d/r)^4) at the farthest reading, 1 from r on.
[[nodiscard]] inline EffectFinding FindEngineWindow(const Scene& scene) {
  if (!scene.window || !(scene.window->range_m > 0.0)) return NotApplicable("no range");
  if (!FollowsDistance(scene)) return NotApplicable("no distance law");
  const double ratio = FarthestDistance(scene) / scene.window->range_m;
  const double w = std::clamp(1.0 - ratio * ratio * ratio * ratio, 0.0, 1.0);
  return {1.0 - (scene.window->squared ? w * w : w), Treatment::kModelled, 0.0,
          "its range against the farthest distance"};
}

}  // namespace lightcal::effects
