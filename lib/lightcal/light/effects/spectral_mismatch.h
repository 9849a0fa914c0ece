// SPDX-License-Identifier: Apache-2.0
// A meter whose colour response is not V(lambda).
#pragma once

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// f1' of a class B meter, DIN 5032-7.
inline constexpr double kSpectralF1Default = 0.06;

//   bound = f1' for white light (random heads: largest error 0.82 f1'); coloured light may reach 4
//   f1'.
[[nodiscard]] inline EffectFinding FindSpectralMismatch(const Scene& scene) {
  if (scene.spectral_f1) {
    return {*scene.spectral_f1, Treatment::kWidens, 0.0,
            "the meter's stated f1', which repeated readings do not lower; white light assumed"};
  }
  return {kSpectralF1Default, Treatment::kInsideSigma, 0.0,
          "no spectral_f1 given (class B: 6 %); the meter's sigma is taken to hold it"};
}

}  // namespace lightcal::effects
