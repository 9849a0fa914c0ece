// SPDX-License-Identifier: Apache-2.0
// The options of `lightcal dome` that say what the pictures are and what the meter read.
#pragma once

#include <string>
#include <vector>

#include "lightcal/calibrate/dome/read_dome.h"
#include "lightcal/core/result.h"
#include "lightcal/imaging/panorama/measure_dome.h"
#include "lightcal/photometry/exposure.h"

namespace CLI {
class App;
}

namespace lightcal::app {

struct DomeOptions {
  std::vector<std::string> files;
  std::string lux, lux_sigma = "5%", lux_direction = "up", lux_shaded;
  std::string convention, clip, north;
  std::string projection, fov, width;  // empty: as the files say, else latlong
  std::vector<std::string> aims;
  std::vector<std::string> balls;
  std::string ball_reflectance, ball_distance;
  std::string plate, grey_ball, grey_card, grey_reflectance, card_direction, plate_fov, plate_aim;
  std::string bracket, up;
};

void AddDomeOptions(CLI::App& parser, DomeOptions& options);
[[nodiscard]] Result<DomeRequest> DomeRequestOf(const DomeOptions& options);
// The plate that shows something grey; `request` is of the same options.
[[nodiscard]] Result<std::optional<GreyPlate>> GreyPlateOf(
    const DomeOptions& options, const DomeRequest& request,
    const std::optional<CameraSettings>& exposure);

}  // namespace lightcal::app
