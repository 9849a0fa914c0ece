// SPDX-License-Identifier: Apache-2.0
// Distances read wrongly: each by itself, and all by the same amount.
#pragma once

#include <algorithm>
#include <string>

#include "lightcal/core/numbers_text.h"
#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// A tape measure held by hand.
inline constexpr double kDistanceErrorMetres = 0.005;
// 1 sigma of what one distance is off by where a mark of the tape was chosen and the meter put
// there.
inline constexpr double kDistanceSigmaMetres = 0.002;

//   bound = 1/(1 - u/d)^2 - 1, u = 5 mm or what is stated, d the nearest distance. A common error
//   of distance is a distance offset, which is fitted; each reading's own is in its sigma. Places
//   have no such sigma.
[[nodiscard]] inline EffectFinding FindDistanceError(const Scene& scene) {
  if (!FollowsDistance(scene)) return NotApplicable("no distance law");
  const double error = scene.distance_error_m.value_or(kDistanceErrorMetres);
  const double left = 1.0 - std::min(0.9, error / NearestDistance(scene));
  const double bound = 1.0 / (left * left) - 1.0;
  const std::string size = RoundedText(1000.0 * error, 2) + " mm at the nearest distance; ";
  if (!scene.distance_error_m) {
    return {bound, Treatment::kFitted, 0.0, size + "the distance offset takes up the common part"};
  }
  return {.bound = bound,
          .treatment = Treatment::kInsideSigma,
          .reason = size +
                    "each reading's own is in its sigma, what they have in common in the "
                    "distance offset",
          .sd = 0.0};
}

}  // namespace lightcal::effects
