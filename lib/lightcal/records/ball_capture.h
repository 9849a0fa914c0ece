// SPDX-License-Identifier: Apache-2.0
// What a session says of a picture of a mirror ball ([capture.ball]).
#pragma once

#include <array>
#include <optional>

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"

namespace lightcal {

// 1 sigma of each coordinate of the camera, and of its aim.
inline constexpr double kSigmaCameraPosition = 0.005;
inline constexpr double kSigmaCameraAimDegrees = 0.3;

struct BallDescription {
  Metres diameter{0.0};
  std::optional<std::array<int, 4>> rect;  // x, y, width, height of the box around its outline
  Vec3 camera_position_m{};                // of the entrance pupil, in the session's axes
  std::optional<Vec3> camera_aim;          // any length above 0
  Radians camera_roll{0.0};                // its top leaning to the right
};

}  // namespace lightcal
