// SPDX-License-Identifier: Apache-2.0
// Electrons that a patch of a picture counts.
#pragma once

#include <cmath>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// A hundred pixels of a thousand electrons.
inline constexpr double kElectronsDefault = 1e5;

//   bound = 3/sqrt(N), N the electrons of the whole patch.
[[nodiscard]] inline EffectFinding FindNoise(const Scene& scene) {
  if (!scene.picture) return NotApplicable("no picture");
  return {3.0 / std::sqrt(scene.picture->electrons.value_or(kElectronsDefault)),
          Treatment::kInsideSigma, 0.0, "three standard deviations; the picture's sigma holds it"};
}

}  // namespace lightcal::effects
