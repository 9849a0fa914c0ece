// SPDX-License-Identifier: Apache-2.0
// An environment kept as spherical harmonics of order 2.
#pragma once

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

//   bound = 3/32 int L dw/E of its small lights: the kernel 1/4 + c/2 + 5/16 P2(c) leaves the
//   cosine by at most 3/32, at grazing light (6.25 % of a light that is faced).
[[nodiscard]] inline EffectFinding FindShTruncation(const Scene& scene) {
  if (!scene.probe) return NotApplicable("no spherical harmonics");
  return {0.09375 * scene.probe->small_lights, Treatment::kModelled, 0.0,
          "take its sun and lamps out as lights of their own"};
}

}  // namespace lightcal::effects
