// SPDX-License-Identifier: Apache-2.0
// The samples of a Radiance HDR picture. Pure.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal::devices {

struct RadiancePixels {
  int width = 0, height = 0;
  std::vector<float> samples;  // three a pixel, from the upper left, row after row
};

// `bytes` are the whole file, with a header that ParseRadianceHeader understands. A sample is
//   (m + 1/2) 2^(e - 136)     m, e the bytes of mantissa and exponent; 0 where e is 0
// since writers cut m off: without the half all are .2 to .4 % too dark. Flat, old and new run
// lengths, and all eight scan orders (those that begin with X are turned).
// Without samples where they are not wanted.
// Refused: bad_picture (no size, cut short, runs beyond a row), too_large.
// Source: Ward, Radiance 5, color.c (colr_color, freadcolrs) and ray/doc/filefmts.
[[nodiscard]] Result<RadiancePixels> ReadRadiancePixels(std::string_view bytes,
                                                        std::string_view name, bool with_samples);

}  // namespace lightcal::devices
