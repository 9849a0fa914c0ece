// SPDX-License-Identifier: Apache-2.0
// What a session says of a picture of a lit wall ([capture.wall]).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/records/charuco_board.h"

namespace lightcal {

// 1 sigma of each coordinate of the lamp against the board.
inline constexpr double kSigmaLampPosition = 0.01;

struct WallDescription {
  CharucoBoard board;
  std::string board_frame;  // the board, by the camera where it stands; "" = it hangs in the frames
  std::string board_views;  // wildcard: further pictures of the board, by the same lens and focus
  std::string off_frames;   // the same wall with the lamp off, as `frames`; "" = not taken
  double position_sigma_m = kSigmaLampPosition;
  // n of cos^n(angle off the lens's axis) that the frames still fall off by; absent = unknown.
  std::optional<double> vignetting;
  std::optional<Metres> sensor_width;            // with the files' focal length: a start and prior
  std::vector<std::array<int, 4>> masks;         // x, y, width, height of what is no plain wall
  std::vector<std::array<int, 4>> shadows;       // likewise, around shadows of a card near the lamp
  std::optional<std::array<int, 3>> paint_srgb;  // the wall's paint, 1 to 255, as its maker prints
  std::optional<std::array<int, 4>> anchor_rect;  // where anchor_illuminance_lx was read
};

}  // namespace lightcal
