// SPDX-License-Identifier: Apache-2.0
// Rows of a picture that see a flickering lamp at different moments.
#pragma once

#include <algorithm>

#include "lightcal/light/effects/effect.h"
#include "lightcal/light/effects/flicker.h"

namespace lightcal::effects {

// Rows averaged over this long where nobody says how long: a hundred rows of 20 us.
inline constexpr double kRowsDefault_s = 2e-3;

//   bound = FlickerBound over max(exposure, time of the rows averaged).
[[nodiscard]] inline EffectFinding FindRollingShutter(const Scene& scene) {
  if (!scene.picture) return NotApplicable("no picture");
  if (scene.time.daylight) return NotApplicable("daylight does not flicker");
  if (scene.picture->rows_s && !(*scene.picture->rows_s > 0.0)) {
    return NotApplicable("a global shutter");
  }
  const double window = std::max(scene.picture->exposure_s.value_or(1.0 / 60.0),
                                 scene.picture->rows_s.value_or(kRowsDefault_s));
  return {.bound = FlickerBound(scene.time, window),
          .treatment = Treatment::kWidens,
          .reason = "bands of the flicker, averaged over the patch's rows",
          .of_pictures = true};
}

}  // namespace lightcal::effects
