// SPDX-License-Identifier: Apache-2.0
// What a picture's channels are as colours.
#pragma once

#include <array>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/result.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// XYZ = M (red, green, blue) of the frame's signals, as seen under the scene's own light (no
// adaptation). Scaled so that a surface of the neutral colour whose green signal is 1 has Y = 1:
// white balance and the choice of a matrix cannot move the scale of luminance.
struct PictureColor {
  Matrix3 xyz_from_rgb{};
  bool has_colour = true;  // false: one channel, or nobody knows; then Y alone means something
  Warnings warnings;       // no_colour_matrix, primaries_assumed
};

// Camera RAW: the DNG matrices at the light that AsShotNeutral names (Adobe DNG 1.6 chapter 6);
// without matrices the green pixels alone, which is exact for neutral surfaces only (warned).
// RGB pictures: their chromaticities, else sRGB's; Radiance files: Radiance's own.
// Refused: no_colour (two channels, more than three, a matrix that cannot be inverted).
[[nodiscard]] Result<PictureColor> ColorOfPicture(const FrameInfo& info);

}  // namespace lightcal
