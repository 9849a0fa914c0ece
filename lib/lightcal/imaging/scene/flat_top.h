// SPDX-License-Identifier: Apache-2.0
// Was a picture cut off at its brightest?
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightcal/core/view2d.h"

namespace lightcal {

// Samples that hold the largest value of all, and those just below it.
struct FlatTop {
  float value = 0.0F;
  int at = 0, below = 0;
};
[[nodiscard]] FlatTop TopOf(std::span<const float> samples);

// Of what rises smoothly to its largest value as many samples lie just below it, in 16 bit floats
// and RGBE too: where hardly any do, the picture was cut off there, or drawn. `least`: so many
// share it.
[[nodiscard]] bool IsCutOff(const FlatTop& top, int least);

// Pixels at the picture's largest luminance, and at a channel's largest value, where they are cut
// off there, or drawn flat: 1. Empty: none is. `samples` interleaved; a luminance a pixel.
[[nodiscard]] std::vector<std::uint8_t> CutOffPixels(std::span<const float> samples, int channels,
                                                     std::span<const float> nits);

// Whether formats end here: full scale of integers and of what is scaled to 1, 16 bit floats.
[[nodiscard]] bool IsFormatsEnd(float sample);

// Row after row 1 for each pixel of which a sample is at the level or above, else 0.
[[nodiscard]] std::vector<std::uint8_t> PixelsFrom(View2d<const float> samples, double level);

}  // namespace lightcal
