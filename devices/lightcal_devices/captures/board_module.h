// SPDX-License-Identifier: Apache-2.0
// The door to OpenCV's boards, charts and features: what the module lightcal_board.so answers. Both
// sides are built together.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/view2d.h"
#include "lightcal/records/charuco_board.h"
#include "lightcal/records/picture_feature.h"

namespace lightcal::devices {

// The functions of imaging/scene/charuco.h, imaging/camera/find_chart.h and
// imaging/panorama/find_features.h.
struct BoardFunctions {
  Result<std::vector<BoardRectangle>> (*lay_out)(const CharucoBoard& board);
  Result<std::vector<BoardCorner>> (*find)(View2d<const float> luminance,
                                           const CharucoBoard& board);
  Result<std::array<double, 8>> (*find_chart)(View2d<const float> rgb);
  std::vector<PictureFeature> (*find_features)(View2d<const std::uint8_t> grey,
                                               View2d<const std::uint8_t> seen, int most);
};
inline constexpr const char* kBoardEntrySymbol = "lightcal_board_functions";

// Opens the module at the first call and keeps it.  Fails: no_board_module.
[[nodiscard]] Result<const BoardFunctions*> BoardModule();

}  // namespace lightcal::devices
