// SPDX-License-Identifier: Apache-2.0
// Fitted lights where they are to stand.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/light/placed_lamp.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

// "NAME=x,y,z", or "x,y,z" where there is one light: overrides what the lights say.
struct LampPlaces {
  std::vector<std::string> position, aim, axis;
};

// The lights named (none: all), in the file's order. session, where there is one, adds the axes of
// rects and tubes, which a light.json does not hold. A disk, rect, spot or photometric light
// without an aim shines straight down (aim_unknown); a spot without a cone shines evenly
// (cone_unknown), a flat lamp or tube without a size is a point of its kind (size_unknown).
// Refused: unknown_light, position_unknown, no_intensity. Wrong usage: a place that cannot be read.
[[nodiscard]] Result<std::vector<PlacedLamp>> PlaceLamps(const LightFile& file,
                                                         const Session* session,
                                                         const std::vector<std::string>& names,
                                                         const LampPlaces& places,
                                                         Warnings& warnings);

// "1,2,0.5" with lengths as ParseLength reads them ("1m,2ft,50cm").
[[nodiscard]] Result<Vec3> ParsePoint(const std::string& option, const std::string& text);
// "0,0,-1": any length above 0; unit.
[[nodiscard]] Result<Vec3> ParseUnitVector(const std::string& option, const std::string& text);

}  // namespace lightcal::app
