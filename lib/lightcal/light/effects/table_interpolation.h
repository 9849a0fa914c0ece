// SPDX-License-Identifier: Apache-2.0
// Intensity between the nodes of a table.
#pragma once

#include <algorithm>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// Beyond this step a lobe may hide between two nodes, and no bound is to be trusted.
inline constexpr double kLargestStep_rad = 0.0873;  // 5 degrees

//   bound = 2.2 max|second difference|/8 over the intensity at the reading, linear along a plane.
//   300 smooth lobes: at least 1.05 times the largest error, 2.1 times in the median.
[[nodiscard]] inline EffectFinding FindTableInterpolation(const Scene& scene) {
  if (!scene.table) return NotApplicable("no table of directions");
  if (!(LargestEmission(scene) > 0.0)) {
    return {0.0, Treatment::kModelled, 0.0, "the readings face a node of the table"};
  }
  const double bound =
      2.2 * scene.table->second_difference / (8.0 * std::max(1e-6, scene.table->least_part));
  if (scene.table->step_rad > kLargestStep_rad * 1.001) {
    return {bound, Treatment::kWidens, 0.0,
            "its nodes lie more than 5 degrees apart: a lobe may hide between them"};
  }
  return {bound, Treatment::kWidens, 0.0, "second differences of the table"};
}

}  // namespace lightcal::effects
