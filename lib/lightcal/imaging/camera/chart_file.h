// SPDX-License-Identifier: Apache-2.0
// A colour chart as its maker or its owner measured it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/result.h"

namespace lightcal {

struct ChartFilePatch {
  std::string name;
  int column = 1, row = 1;  // from 1, from the upper left
  Xyz xyz;                  // in D50, Y = 100: perfect white
};

struct ChartFile {
  // Centres of the corner patches in the picture: upper left, upper right, lower right, lower left,
  // as the chart is read. Absent = a chart of 6 x 4 patches that is to be looked for.
  std::optional<std::array<double, 8>> corners;
  std::optional<Xy> lamp;  // white of the light that lit it; absent = D50, as the references
  std::vector<ChartFilePatch> patches;
  int columns = 0, rows = 0;
};

// Comma separated; # begins a comment:
//   corners, x, y, x, y, x, y, x, y        in pixels; optional where the chart has 6 x 4 patches
//   lamp_xy, x, y                          optional
//   name, column, row, L, a, b             CIELAB of D50; or X, Y, Z of D50, Y = 100 for white
//   dark skin, 1, 1, 37.5, 14.4, 14.9      one line a patch
// Refused: bad_chart, naming file and line.
[[nodiscard]] Result<ChartFile> ParseChartFile(std::string_view text, const std::string& where);

}  // namespace lightcal
