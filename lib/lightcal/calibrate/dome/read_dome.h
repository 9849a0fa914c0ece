// SPDX-License-Identifier: Apache-2.0
// Panorama files -> a dome in cd/m^2 and the lights in it.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/imaging/panorama/measure_dome.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// One lat-long panorama as it is, or views composed to one.
// Refused: as Sources::read_masked_frame, LuminanceOfPicture, PixelSolidAngles, ComposeViews;
// over_range (a pixel no scene has).
[[nodiscard]] Result<DomeInput> ReadDomeInput(const DomeInputRequest& request,
                                              const Sources& sources);

// Refused: as ReadDomeInput, MeasureDome.
[[nodiscard]] Result<MeasuredDome> MeasureDome(const DomeRequest& request, const Sources& sources);

}  // namespace lightcal
