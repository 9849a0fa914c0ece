// SPDX-License-Identifier: Apache-2.0
// Directions and domes turned about Z.
#pragma once

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/imaging/panorama/dome_lights.h"

namespace lightcal {

// A direction of the picture's own frame as the answer has it, and back: a turn about Z.
[[nodiscard]] Vec3 TurnedNorth(const Vec3& direction, Radians north);
// The dome turned likewise: the column that looks north comes to the middle. Rows keep their sums.
void TurnNorth(Radians north, Dome& dome);

struct AzimuthElevation {
  double azimuth_deg = 0.0, elevation_deg = 0.0;
};
[[nodiscard]] AzimuthElevation AnglesOf(const Vec3& direction);

}  // namespace lightcal
