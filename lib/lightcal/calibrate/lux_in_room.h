// SPDX-License-Identifier: Apache-2.0
// What a meter sees of fitted lamps, and of the walls they light, in the room they were measured
// in.
#pragma once

#include <optional>

#include "lightcal/core/uncertain.h"
#include "lightcal/light/illuminance_map.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// E [lx] on the surface `at` of `light` standing as `placed`, `alone` being what the lamp itself
// casts there (IlluminancePredictor::At). The walls' part is as the fit found it for a meter that
// faces the lamp (PredictInRoom); turned away, or off the axis of a lamp that has one, a meter sees
// other walls: ln of theirs then scatters by .4 more, as surfaces of traced rooms do. Absent where
// no walls were fitted, for lights from everywhere, and for a located lamp that stands elsewhere.
[[nodiscard]] std::optional<Uncertain> LuxInRoom(const FittedLight& light, const PlacedLamp& placed,
                                                 const LampLux& alone, const SurfacePoint& at);

}  // namespace lightcal
