// SPDX-License-Identifier: Apache-2.0
// A lens that darkens towards its corners.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// A patch nobody places stands a third of the way out of an ordinary lens.
inline constexpr double kFieldDefault_rad = 0.2;
// What such a lens sees in its corner: where a patch stands in the picture tells its angle.
inline constexpr double kCornerDefault_rad = 0.6;

//   bound = 1 - cos^4 t, t the angle off the lens's axis.
[[nodiscard]] inline EffectFinding FindVignetting(const Scene& scene) {
  if (!scene.picture) return NotApplicable("no picture");
  if (scene.picture->flat_field) return NotApplicable("the flat field takes it out");
  const double t = scene.picture->off_middle_rad.value_or(kFieldDefault_rad);
  const double cosine = std::cos(std::min(t, 0.5 * std::numbers::pi));
  return {.bound = 1.0 - std::pow(cosine, 4),
          .treatment = Treatment::kWidens,
          .reason = "no flat field: a patch off the picture's middle reads low by up to this",
          .of_pictures = true};
}

}  // namespace lightcal::effects
