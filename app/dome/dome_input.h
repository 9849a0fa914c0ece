// SPDX-License-Identifier: Apache-2.0
// Panorama files as one dome, on whatever scale they have.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/dome_lights.h"
#include "lightcal/imaging/panorama.h"
#include "lightcal/imaging/picture_luminance.h"

namespace lightcal::app {

struct DomeInputRequest {
  std::vector<std::string> files;
  std::optional<LuminanceConvention> convention;  // absent: photometric, relative if no file says
  std::optional<double> clip;  // samples of a file from here on are clipped, in the file's own unit
};

struct DomeInput {
  Dome dome;
  std::vector<std::uint8_t> clipped;  // by pixel; empty = nothing is known to be
  std::string scale;                  // as PictureLuminance has it, or what a merge wrote
  bool absolute = false;              // the scale is meant as cd/m^2 by file or person
  std::optional<double> scale_u95_relative;
  std::optional<RgbPrimaries> primaries;  // the file's own
  bool has_colour = false;
  std::vector<std::string> files;
  Warnings warnings;
};

// One lat-long panorama as it is.
// Refused: as ReadFrame, LuminanceOfPicture, PixelSolidAngles; over_range (a pixel no scene has).
[[nodiscard]] Result<DomeInput> ReadDomeInput(const DomeInputRequest& request);

}  // namespace lightcal::app
