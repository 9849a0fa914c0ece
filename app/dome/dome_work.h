// SPDX-License-Identifier: Apache-2.0
// Panorama files -> a dome in cd/m^2 and the lights in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dome/dome_input.h"
#include "lightcal/core/result.h"
#include "lightcal/imaging/panorama/dome_lights.h"
#include "lightcal/imaging/panorama/dome_scale.h"

namespace lightcal::app {

struct DomeRequest {
  DomeInputRequest input;
  std::optional<DomeReading> reading;  // normal as people see the answer: after `north`
  Radians north{0.0};                  // azimuth, right of the picture's centre, of what becomes +Y
};

struct MeasuredDome {
  DomeInput input;  // samples in cd/m^2, in the picture's own frame, lights still in it
  std::vector<DomeLight> lights;    // brightest first; directions in the picture's own frame
  std::vector<double> sd_relative;  // of the lights' illuminance
  DomeScale scale;
  std::string scale_source;  // "lux" "lux_shaded", else the input's
  std::optional<double> scale_u95_relative;
  Radians north{0.0};
  Warnings warnings;
};

// Refused: all_black, all_saturated, over_range, and as ReadDomeInput, ScaleDome.
// Warned: maybe_clipped, scale_conflict, clipped_lights_share, and what the input warns of.
[[nodiscard]] Result<MeasuredDome> MeasureDome(const DomeRequest& request);

// A direction of the picture's own frame as the answer has it, and back: a turn about Z.
[[nodiscard]] Vec3 TurnedNorth(const Vec3& direction, Radians north);
// The dome turned likewise: the column that looks north comes to the middle. Rows keep their sums.
void TurnNorth(Radians north, Dome& dome);

// "up", "down", or "AZIMUTH,ELEVATION" in degrees: right of +Y, above the horizon.
[[nodiscard]] Result<Vec3> ParseDirection(const std::string& option, const std::string& text);
struct AzimuthElevation {
  double azimuth_deg = 0.0, elevation_deg = 0.0;
};
[[nodiscard]] AzimuthElevation AnglesOf(const Vec3& direction);

}  // namespace lightcal::app
