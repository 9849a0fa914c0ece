// SPDX-License-Identifier: Apache-2.0
// Bits that a stored picture keeps.
#pragma once

#include <cmath>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

//   bound = 2^-bits: 2^-11 half floats, 2^-9 RGBE.
[[nodiscard]] inline EffectFinding FindStorage(const Scene& scene) {
  if (!scene.picture) return NotApplicable("no picture");
  return {std::ldexp(1.0, -scene.picture->significant_bits), Treatment::kInsideSigma, 0.0,
          "rounding of the stored samples"};
}

}  // namespace lightcal::effects
