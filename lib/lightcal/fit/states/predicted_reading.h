// SPDX-License-Identifier: Apache-2.0
// What a fitted lamp shows a meter where a reading of another state was taken.
#pragma once

#include <optional>

#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

struct PredictedReading {
  double lux = 0.0;          // of the lamp and its walls, without other light
  double sd_relative = 0.0;  // the meter's own scale is in it
};

// `light` as fitted from `description`. By the reading's distance, its angle off the axis and its
// tilt, or its position and normal where the lamp's place is stated:
//   E = I m(p) cos(t) + W(d),
// m the lamp's exact form there (fit/model/off_axis.h), its table's part or 1/(d + d0)^2, W what
// the walls add on the axis at that distance. Absent where nothing says how it shines there.
[[nodiscard]] std::optional<PredictedReading> PredictReading(const LightDescription& description,
                                                             const FittedLight& light,
                                                             const Reading& reading);

}  // namespace lightcal::fit
