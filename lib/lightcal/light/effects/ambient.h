// SPDX-License-Identifier: Apache-2.0
// Light of other sources in every reading.
#pragma once

#include <algorithm>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// Of the dimmest reading, where nothing tells it: what curtains and standby lamps leave.
inline constexpr double kAmbientDefault = 0.05;

//   E = E_lamp + E0,   bound = E0/E at the dimmest reading.
[[nodiscard]] inline EffectFinding FindAmbient(const Scene& scene) {
  const bool differenced = std::all_of(scene.poses.begin(), scene.poses.end(),
                                       [](const ScenePose& pose) { return pose.differenced; });
  if (differenced) {
    return {0.0, Treatment::kFitted, 0.0, "the shadow-card readings subtract it"};
  }
  if (scene.ambient_ratio) {
    return {std::max(0.0, *scene.ambient_ratio), Treatment::kFitted, 0.0,
            "measured by lamp-off readings"};
  }
  if (scene.distances >= 4) {
    return {1.0, Treatment::kFitted, 0.0,
            "fitted: four distances tell it from the lamp; it cannot exceed the dimmest reading"};
  }
  return {kAmbientDefault, Treatment::kUnknown, 2.0,
          "no lamp-off or shadow-card reading; taken as 0 (5 % of the dimmest reading is common)"};
}

}  // namespace lightcal::effects
