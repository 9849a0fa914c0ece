// SPDX-License-Identifier: Apache-2.0
// A sphere in a picture: the box around its outline -> the cone of sight that touches it.
#pragma once

#include <array>
#include <optional>

#include "lightcal/core/vec3.h"
#include "lightcal/imaging/panorama/panorama.h"

namespace lightcal {

struct BallCone {
  Vec3 axis;           // unit, towards the ball's middle, in the picture's frame
  double angle = 0.0;  // half, radians: sin(angle) = radius / distance of the middle
};

// The sphere that fills the box x, y, width, height [pixels] on all four sides. Absent where none
// does within 2 % of its side (a pixel at least), or where it is not wholly in the picture.
[[nodiscard]] std::optional<BallCone> ConeOfBall(const PixelSolidAngles& view,
                                                 const std::array<double, 4>& outline);

}  // namespace lightcal
