// SPDX-License-Identifier: Apache-2.0
// What a picture's channels are as colours.
#pragma once

#include <array>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/result.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// XYZ = M (red, green, blue) of the frame's signals, as seen under the scene's own light (no
// adaptation). Of camera RAW a D65 white whose green signal is 1 has Y = 1, the scale of ISO
// speeds: the camera's white balance, a wish about rendering, moves neither luminance nor colour.
struct PictureColor {
  Matrix3 xyz_from_rgb{};
  bool has_colour = true;  // false: one channel, or nobody knows; then Y alone means something
  Warnings warnings;       // no_colour_matrix, primaries_assumed
};

// Camera RAW: its matrix for daylight (DaylightXyzFromRaw), to which the spectral factors belong;
// without matrices the green pixels alone, which is exact for neutral surfaces only (warned).
// RGB pictures: their chromaticities, else Rec. 709's, also of Radiance files, which today come
// from programs that mean these (warned: primaries_assumed, but for OpenEXR, where it is the
// standard); XYZ files as they are. Refused: no_colour (two channels, more than three, a matrix
// that cannot be inverted).
[[nodiscard]] Result<PictureColor> ColorOfPicture(const FrameInfo& info);

}  // namespace lightcal
