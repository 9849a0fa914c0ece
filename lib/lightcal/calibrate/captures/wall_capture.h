// SPDX-License-Identifier: Apache-2.0
// use = "wall": a lit wall with a printed board -> the lamp's distribution.
#pragma once

#include <vector>

#include "lightcal/calibrate/evidence.h"
#include "lightcal/core/result.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// One light for each [[capture]] of use = "wall", in their order. The board gives wall coordinates
// (records/charuco_board.h), in which position_m and aim of the light are meant; without an aim
// the lamp aims straight at the wall.
//   I(direction) = (pi L/rho - E_other) r^2/cos(incidence), smoothed by FitDistribution
// E_other what the room throws back, others shine and the lens scatters (FindOtherLight).
// intensity_cd is the peak and flux_lm what leaves within the covered cone. Their intervals hold:
// position_sigma_m, the camera's pose and lens (SolveCamera), the lens's falloff (wall.vignetting
// +- 0.25; unknown: 3 +- 1.5), a wall that is not quite matt (10 % missing at grazing light, 5 %
// at grazing sight), the board's size (0.2 %), scale and reflectance, noise, E_other, what a lamp
// of stated size gives less so near, what the lamp does in time (FindLampInPictures), and what the
// splines leave over. The colour is that of what
// shows the wall, less what its paint and the room do to it (fit/colour/off_wall.h). Refused:
// position_unknown, not_in_front, wall_needs_photometric, bad_region (wall.shadows are off the
// wall, or no shadows), and as ReadPosedWall, BlocksOfWall, FitDistribution.
[[nodiscard]] Result<std::vector<FittedLight>> MeasureWalls(const Session& session,
                                                            const Sources& sources,
                                                            const FitSettings& settings,
                                                            Evidence& evidence);

}  // namespace lightcal
