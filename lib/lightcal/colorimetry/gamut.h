// SPDX-License-Identifier: Apache-2.0
// What is done with colours outside an RGB space.
#pragma once

#include "lightcal/colorimetry/rgb_spaces.h"

namespace lightcal {

enum class GamutPolicy {
  kKeep,        // negative components stay: exact, and some engines refuse them
  kClip,        // they become 0: hue and luminance shift
  kDesaturate,  // mixed with the space's white of the same luminance until none is negative
};

[[nodiscard]] constexpr bool IsInGamut(const Rgb& c) {
  return c.r >= 0.0 && c.g >= 0.0 && c.b >= 0.0;
}

// kDesaturate: c + s (Y - c) with the least s in [0, 1] that leaves no component below 0; keeps
// luminance and the direction from white.  Holds for a colour of luminance Y > 0.
[[nodiscard]] Rgb FitToGamut(const Rgb& color, RgbSpace space, GamutPolicy policy);

}  // namespace lightcal
