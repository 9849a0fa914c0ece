// SPDX-License-Identifier: Apache-2.0
// Mains voltage on a filament lamp.
#pragma once

#include <cmath>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

inline constexpr double kMainsVariation = 0.01;

//   bound = (1 + dV)^3.5 - 1 at dV = 1 %, for tungsten; a regulated LED follows it hardly at all.
[[nodiscard]] inline EffectFinding FindMains(const Scene& scene) {
  const double bound = std::pow(1.0 + kMainsVariation, 3.5) - 1.0;
  if (scene.time.filament && !*scene.time.filament) {
    return NotApplicable("no filament: its driver regulates");
  }
  if (scene.time.filament) {
    return {bound, Treatment::kWidens, 0.0, "a filament follows 1 % of mains by 3.5 %"};
  }
  return {bound, Treatment::kUnknown, 0.0,
          "only filament lamps follow the mains (3.5 % per 1 %), and no lamp type is stated"};
}

}  // namespace lightcal::effects
