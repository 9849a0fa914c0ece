// SPDX-License-Identifier: Apache-2.0
// Where lamps are to stand, as a person types it.
#pragma once

#include <string>
#include <vector>

#include "lightcal/calibrate/place_lamps.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

// "NAME=x,y,z", or "x,y,z" where there is one light.
struct LampPlaceWords {
  std::vector<std::string> position, aim, axis;
};

// Wrong usage: a place that cannot be read, or of a light that is not among `lights`.
[[nodiscard]] Result<LampPlaces> ParseLampPlaces(const LampPlaceWords& words,
                                                 const std::vector<const FittedLight*>& lights);

// "1,2,0.5" with lengths as ParseLength reads them ("1m,2ft,50cm").
[[nodiscard]] Result<Vec3> ParsePoint(const std::string& option, const std::string& text);
// How a meter is turned: "up", "x,y,z", or "lamp" (absent: towards a lamp, which the caller knows).
[[nodiscard]] Result<std::optional<Vec3>> ParseMeterNormal(const std::string& text);
// "0,0,-1": any length above 0; unit.
[[nodiscard]] Result<Vec3> ParseUnitVector(const std::string& option, const std::string& text);

}  // namespace lightcal::app
