// SPDX-License-Identifier: Apache-2.0
// A dome as it was read -> in cd/m^2, and the lights in it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/panorama/dome_input.h"
#include "lightcal/imaging/panorama/dome_lights.h"
#include "lightcal/imaging/panorama/dome_scale.h"

namespace lightcal {

struct DomeRequest {
  DomeInputRequest input;
  std::optional<DomeReading> reading;  // normal as people see the answer: after `north`
  Radians north{0.0};                  // azimuth, right of the picture's centre, of what becomes +Y
};

struct MeasuredDome {
  DomeInput input;  // samples in cd/m^2, in the picture's own frame, lights still in it
  std::vector<DomeLight> lights;    // brightest first; directions in the picture's own frame
  std::vector<double> sd_relative;  // of the lights' illuminance, where the unit is known
  DomeScale scale;
  std::string scale_source;                  // "lux" "lux_shaded", else the input's
  std::optional<double> scale_u95_relative;  // in ln where scale.range_ln is above 0
  double missing_sd = 0.0;  // of the scale, by light that a picture cut off may lack; relative
  bool unit_known = false;  // samples are cd/m^2 by file, person or reading
  Radians north{0.0};
  Warnings warnings;
};

// An illuminance of the dome, or of a light in it, that is as sure as said where the unit is known;
// where it is not, as sure as one may be that 1.0 is 1 cd/m^2 (kUnstatedUnitSdLn).
[[nodiscard]] Uncertain LuxOfDome(const MeasuredDome& measured, double value_lx,
                                  double sd_relative);

// Of lights[index]: where it may be clipped, up to what it can be.
[[nodiscard]] Uncertain LuxOfLight(const MeasuredDome& measured, std::size_t index);

// Refused: all_black, all_saturated, reading_beyond_view, and as ScaleDome.
// Warned: maybe_clipped, scale_conflict, shading_conflict, clipped_lights_share, brighter_than_sun
// (a light of more than 150 klx), sun_below_horizon, and what the input warns of.
[[nodiscard]] Result<MeasuredDome> MeasureDome(DomeInput input, const DomeRequest& request);

}  // namespace lightcal
