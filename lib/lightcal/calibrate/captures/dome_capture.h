// SPDX-License-Identifier: Apache-2.0
// use = "dome": a panorama or a fisheye picture -> the illuminance of all that surrounds the scene.
#pragma once

#include "lightcal/calibrate/captures/capture_reading.h"

namespace lightcal {

// For a light of kind = "dome": what an upward plane in the panorama's middle gets from it, lights
// and all, and the colour of that light. anchor_illuminance_lx is a lux meter's reading there,
// lying flat; without it the picture must be in cd/m^2. A fisheye looks up. Refused: not_a_dome
// (another kind), several_pictures, no_scale, and as MeasureDome.
[[nodiscard]] Result<CaptureReading> ReadDomeCapture(const Session& session,
                                                     const CaptureDescription& capture,
                                                     const Sources& sources, Evidence& evidence);

}  // namespace lightcal
