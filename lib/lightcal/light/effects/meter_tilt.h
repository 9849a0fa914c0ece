// SPDX-License-Identifier: Apache-2.0
// A meter that does not face the lamp.
#pragma once

#include <cmath>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// How well a person points a meter.
inline constexpr double kPointingDegrees = 3.0;

//   E = I cos(t)/d^2,   bound = (1 - cos t) + tan t sin(delta) + 2 sin^2(delta/2), t the largest
//   tilt stated and delta = 3 degrees the pointing error: the first term is what leaving the cosine
//   out costs, the others what an error of pointing does.
[[nodiscard]] inline EffectFinding FindMeterTilt(const Scene& scene) {
  const double tilt = LargestTilt(scene);
  const double delta = RadiansFromDegrees(kPointingDegrees).value();
  const double half = std::sin(0.5 * delta);
  const double bound =
      (1.0 - std::cos(tilt)) + std::tan(tilt) * std::sin(delta) + 2.0 * half * half;
  return {bound, Treatment::kModelled, 0.0,
          tilt > 0.0 ? "the stated tilt, pointed within 3 degrees"
                     : "the meter faces the lamp within 3 degrees"};
}

}  // namespace lightcal::effects
