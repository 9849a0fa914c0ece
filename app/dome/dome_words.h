// SPDX-License-Identifier: Apache-2.0
// Places, directions and exposures as people type them for `lightcal dome`. All fail as a line
// typed wrong, which says what `option` takes.
#pragma once

#include <array>
#include <string>

#include "lightcal/calibrate/dome/read_dome.h"
#include "lightcal/core/result.h"
#include "lightcal/core/vec3.h"
#include "lightcal/photometry/exposure.h"

namespace lightcal::app {

// "up", "down", or "AZIMUTH,ELEVATION" in degrees: right of +Y, above the horizon.
[[nodiscard]] Result<Vec3> ParseDirection(const std::string& option, const std::string& text);

// "YAW,PITCH[,ROLL]" in degrees: right of +Y, above the horizon, leaning right.
[[nodiscard]] Result<ViewAim> ParseAim(const std::string& option, const std::string& text);

// "VIEW[,PITCH[,ROLL]]": a file's name or its end, or a number from 1; degrees.
[[nodiscard]] Result<LevelView> ParseLevel(const std::string& option, const std::string& text);

// "X,Y,WIDTH,HEIGHT" in pixels, the last two above 0.
[[nodiscard]] Result<std::array<double, 4>> ParsePixelBox(const std::string& option,
                                                          const std::string& text);

// A share of light that something sends back, and its sigma: "R" (known) or "R,SIGMA".
[[nodiscard]] Result<std::array<double, 2>> ParseReflectance(const std::string& option,
                                                             const std::string& text);

// "f/8,1/60,100": f-number, time, ISO speed.   Refused: not_positive.
[[nodiscard]] Result<CameraSettings> ParsePlateExposure(const std::string& option,
                                                        const std::string& text);

}  // namespace lightcal::app
