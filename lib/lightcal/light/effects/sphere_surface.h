// SPDX-License-Identifier: Apache-2.0
// A globe whose distance was measured to its surface instead of its centre.
#pragma once

#include <algorithm>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

//   bound = (1 + R/d)^2 - 1 at the nearest reading; the model adds R to the distance.
[[nodiscard]] inline EffectFinding FindSphereSurface(const Scene& scene) {
  if (scene.kind != LightKind::kSphere || !scene.size.diameter) {
    return NotApplicable("not a sphere of known diameter");
  }
  const bool from_center = std::all_of(scene.poses.begin(), scene.poses.end(),
                                       [](const ScenePose& pose) { return pose.from_center; });
  if (from_center) {
    return {0.0, Treatment::kModelled, 0.0, "positions are given: distances reach the centre"};
  }
  const double ratio = 0.5 * scene.size.diameter->value() / NearestDistance(scene);
  return {
      (1.0 + ratio) * (1.0 + ratio) - 1.0, Treatment::kFitted, 0.0,
      "whether distances reach the surface or the centre is not said; the distance offset takes "
      "it up (+sphere_surface states that they reach the surface)"};
}

}  // namespace lightcal::effects
