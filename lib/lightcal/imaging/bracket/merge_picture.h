// SPDX-License-Identifier: Apache-2.0
// Merged samples -> pixels: colours interpolated where a mosaic leaves them out, matrix applied,
// variances carried along.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lightcal/core/progress.h"
#include "lightcal/core/result.h"
#include "lightcal/core/view2d.h"
#include "lightcal/imaging/bracket/merge_bracket.h"
#include "lightcal/imaging/bracket/sample_corrections.h"

namespace lightcal {

// What each channel of the picture is of merged red, green and blue (of the one channel where there
// is one: the first). Scale included.
struct PictureRows {
  std::vector<std::array<double, 3>> picture;  // one row a channel of the picture: 1 or 3
  std::array<double, 3> luminance{};           // what sigma is the uncertainty of
  SampleCorrections corrections{};             // of the samples, before anything else
};

// Rows [first, first + count) of the picture, row i of the views being row first + i; `sigma` (one
// channel, 1 standard deviation of the luminance row) may be empty. A mosaic's missing colours are
// the mean of the same colour's nearest pixels in 3 x 3 (bilinear); a pixel's variance is that of
// this sum, its neighbours' noise taken as independent; of codes as encoded_errors.h has it. A
// pixel that holds any sample clipped in every frame is a lower bound, its sigma as large as
// itself. Works strip by strip, on all processors. Returns how many samples are clipped in every
// frame. Refused: pattern_unknown (a mosaic with a colour missing in some 3 x 3 pixels, or a
// picture smaller than its pattern).
[[nodiscard]] Result<std::size_t> MergePicture(const BracketMerger& merger, const PictureRows& rows,
                                               int first, int count, View2d<float> picture,
                                               View2d<float> sigma, const Progress& progress = {});

}  // namespace lightcal
