// SPDX-License-Identifier: Apache-2.0
// The options of `lightcal dome` that say what the pictures are and what the meter read.
#pragma once

#include <string>
#include <vector>

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
  std::string projection = "latlong", fov, width;
  std::vector<std::string> aims;
};

void AddDomeOptions(CLI::App& parser, DomeOptions& options);
[[nodiscard]] Result<DomeRequest> DomeRequestOf(const DomeOptions& options);

// "f/8,1/60,100": f-number, time, ISO speed.
[[nodiscard]] Result<CameraSettings> ParsePlateExposure(const std::string& option,
                                                        const std::string& text);

}  // namespace lightcal::app
