// SPDX-License-Identifier: Apache-2.0
// Intensity between the nodes of a table.
#pragma once

#include <algorithm>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// Beyond this step a lobe may hide between two nodes, and no bound is to be trusted.
inline constexpr double kLargestStep_rad = 0.0873;  // 5 degrees

// How much farther than IntensityTable::InterpolationErrorTowards says a lobe may lie.
inline constexpr double kInterpolationMargin = 2.2;

//   bound = 2.2 InterpolationErrorTowards/I of the reading where that is largest. Each reading is
//   widened by its own (ScenePose::table_error).
[[nodiscard]] inline EffectFinding FindTableInterpolation(const Scene& scene) {
  if (!scene.table_step_rad) return NotApplicable("no table of directions");
  double most = 0.0;
  for (const ScenePose& pose : scene.poses) most = std::max(most, pose.table_error);
  if (!(most > 0.0)) {
    return {0.0, Treatment::kModelled, 0.0, "the readings face a node of the table"};
  }
  const bool coarse = *scene.table_step_rad > kLargestStep_rad * 1.001;
  return {kInterpolationMargin * most, Treatment::kWidens, 0.0,
          coarse ? "its nodes lie more than 5 degrees apart: a lobe may hide between them"
                 : "second differences of the table around the reading"};
}

}  // namespace lightcal::effects
