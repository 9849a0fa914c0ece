// SPDX-License-Identifier: Apache-2.0
// Light of the whole picture, scattered over every pixel by the lens.
#pragma once

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// Ordinary lenses scatter 0.5 to 3 %.
inline constexpr double kGlareDefault = 0.03;

//   bound = g L_mean/L_patch.
[[nodiscard]] inline EffectFinding FindVeilingGlare(const Scene& scene) {
  if (!scene.picture) return NotApplicable("no picture");
  const double bound =
      scene.picture->glare.value_or(kGlareDefault) * scene.picture->mean_over_patch.value_or(1.0);
  return {.bound = bound,
          .treatment = Treatment::kWidens,
          .reason = scene.picture->glare ? "the lens's stated glare"
                                         : "no glare of the lens is stated (0.5 to 3 %): keep "
                                           "bright things out of the picture",
          .of_pictures = true};
}

}  // namespace lightcal::effects
