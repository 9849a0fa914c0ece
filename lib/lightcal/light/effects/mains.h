// SPDX-License-Identifier: Apache-2.0
// Mains voltage on a filament lamp.
#pragma once

#include <cmath>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

inline constexpr double kMainsVariation = 0.01;
// Of lamps nobody describes, this part burns a filament.
inline constexpr double kFilamentShare = 0.3;

//   bound = (1 + dV)^3.5 - 1 at dV = 1 %, for tungsten; a regulated LED follows it hardly at all.
//   A lamp of unknown make widens by half of it times sqrt(kFilamentShare): the root mean square.
[[nodiscard]] inline EffectFinding FindMains(const Scene& scene) {
  const double bound = std::pow(1.0 + kMainsVariation, 3.5) - 1.0;
  if (!scene.time.own_lamp) return NotApplicable("a data sheet's lamp has its nominal voltage");
  if (scene.kind == LightKind::kDirectional || scene.kind == LightKind::kDome) {
    return NotApplicable("no lamp on the mains");
  }
  if (scene.time.filament && !*scene.time.filament) {
    return NotApplicable("no filament: its driver regulates");
  }
  EffectFinding finding{.bound = bound,
                        .treatment = Treatment::kWidens,
                        .reason = "a filament follows 1 % of mains by 3.5 %",
                        .own_lamp = true};
  if (!scene.time.filament) {
    finding.reason += "; three lamps in ten have one";
    finding.sd = 0.5 * bound * std::sqrt(kFilamentShare);
  }
  return finding;
}

}  // namespace lightcal::effects
