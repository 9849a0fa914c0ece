// SPDX-License-Identifier: Apache-2.0
// A lamp that is not yet as warm as it will be.
#pragma once

#include <cmath>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// An LED loses a fifth of its first light, with a time constant of a quarter of an hour.
inline constexpr double kWarmUpPart = 0.2;
inline constexpr double kWarmUpTime_s = 900.0;
// How long a lamp of unknown age has been on.
inline constexpr double kOnForDefault_s = 1800.0;

//   I(t) = I_inf (1 + A exp(-t/tau)),   bound = A exp(-t/tau) of the first reading.
[[nodiscard]] inline EffectFinding FindWarmUp(const Scene& scene) {
  if (!scene.time.own_lamp) return NotApplicable("a data sheet's lamp is warm");
  if (scene.kind == LightKind::kDirectional || scene.kind == LightKind::kDome) {
    return NotApplicable("this kind of light does not warm up");
  }
  const double on_for = scene.time.on_for_s.value_or(kOnForDefault_s);
  const double bound = kWarmUpPart * std::exp(-on_for / kWarmUpTime_s);
  return {.bound = bound,
          .treatment = Treatment::kWidens,
          .reason = scene.time.on_for_s
                        ? "the stated time since it was switched on"
                        : "nobody says how long the lamp had been on; after half an hour this much "
                          "may be left",
          .own_lamp = true};
}

}  // namespace lightcal::effects
