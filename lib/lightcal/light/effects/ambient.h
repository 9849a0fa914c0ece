// SPDX-License-Identifier: Apache-2.0
// Light of other sources in every reading.
#pragma once

#include <algorithm>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// Of the dimmest reading, where nothing tells it: what curtains and standby lamps leave. Any part
// of it is as likely as another, so that half of it is about its root mean square.
inline constexpr double kAmbientDefault = 0.05;

//   E = E_lamp + E0,   bound = E0/E at the dimmest reading.
[[nodiscard]] inline EffectFinding FindAmbient(const Scene& scene) {
  const bool differenced = std::all_of(scene.poses.begin(), scene.poses.end(),
                                       [](const ScenePose& pose) { return pose.differenced; });
  if (differenced) {
    return {0.0, Treatment::kFitted, 0.0, "the shadow-card readings subtract it"};
  }
  if (std::ranges::all_of(scene.poses, &ScenePose::of_luminance)) {
    return NotApplicable("a picture of the lamp itself holds no other light");
  }
  if (scene.ambient_ratio) {
    return {std::max(0.0, *scene.ambient_ratio), Treatment::kFitted, 0.0,
            "measured by lamp-off readings"};
  }
  // A constant and light from walls that grows with distance are one to a handful of readings; the
  // ground gives little.
  if (scene.distances >= 4 && (scene.walls.empty() || scene.over_ground)) {
    return {1.0, Treatment::kFitted, 0.0,
            "fitted: four distances tell it from the lamp; it cannot exceed the dimmest reading"};
  }
  if (scene.dark) return NotApplicable("[room] says dark: nothing else shines");
  if (!scene.time.own_lamp) return NotApplicable("a data sheet's lamp was measured in the dark");
  return {
      .bound = kAmbientDefault,
      .treatment = Treatment::kWidens,
      .distance_power = 2.0,
      .reason = "no lamp-off or shadow-card reading; up to 5 % of the dimmest reading is common",
      .own_lamp = true};
}

}  // namespace lightcal::effects
