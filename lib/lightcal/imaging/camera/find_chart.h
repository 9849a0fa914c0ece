// SPDX-License-Identifier: Apache-2.0
// Where the common colour chart of 24 patches is in a picture.
#pragma once

#include <array>

#include "lightcal/core/result.h"
#include "lightcal/core/view2d.h"

namespace lightcal {

inline constexpr int kChartColumns = 6, kChartRows = 4;

// Centres of the corner patches x, y (as ChartGrid::Make takes them), found by OpenCV's mcc in a
// linear picture of three channels, camera RGB or any other, any scale. Which corner is the upper
// left one is mcc's opinion, by the colours of sRGB: a camera's own may turn it by quarters and
// halves. Patches should be 20 pixels wide and more.
// Refused: chart_not_found.
[[nodiscard]] Result<std::array<double, 8>> FindColorChart(View2d<const float> rgb);

}  // namespace lightcal
