// SPDX-License-Identifier: Apache-2.0
// A lens that darkens towards its corners.
#pragma once

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// A patch nobody places stands a third of the way out of an ordinary lens.
inline constexpr double kFieldDefault_rad = 0.2;

//   1 - cos^4 t <= 2 t^2,   bound = 2 t^2, t the angle off the lens's axis.
[[nodiscard]] inline EffectFinding FindVignetting(const Scene& scene) {
  if (!scene.picture) return NotApplicable("no picture");
  if (scene.picture->flat_field) return NotApplicable("the flat field takes it out");
  const double t = scene.picture->off_middle_rad.value_or(kFieldDefault_rad);
  return {.bound = 2.0 * t * t,
          .treatment = Treatment::kWidens,
          .reason = "no flat field: a patch off the picture's middle reads low by up to this",
          .of_pictures = true};
}

}  // namespace lightcal::effects
