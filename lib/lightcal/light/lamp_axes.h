// SPDX-License-Identifier: Apache-2.0
// How a lamp that is known by its aim alone stands in the room.
#pragma once

#include "lightcal/core/vec3.h"

namespace lightcal {

// The axes of the lamp's own frame (intensity_table.h) in the frame of its position, unit length.
struct LampAxes {
  Vec3 c0{1.0, 0.0, 0.0}, c90{0.0, 1.0, 0.0}, aim{0.0, 0.0, -1.0};
};

// C90 as high up (+Z) as the aim lets it be, so that C0 is to the right, seen from behind the lamp
// along its aim; a lamp that aims straight up or down has C0 along +X. aim: any length above 0.
[[nodiscard]] inline LampAxes AxesOfAim(const Vec3& aim) {
  const Vec3 forward = aim * (1.0 / Length(aim));
  const Vec3 level = Cross(forward, Vec3{0.0, 0.0, 1.0});
  constexpr double kVertical = 1e-9;
  const double length = Length(level);
  const Vec3 right = length > kVertical ? level * (1.0 / length) : Vec3{1.0, 0.0, 0.0};
  return {right, Cross(right, forward), forward};
}

// C0 along `along` made square to the aim, where it is said how the lamp is turned about its aim (a
// tube's length, a rect's width); where that leaves nothing, as above.
[[nodiscard]] inline LampAxes AxesOfAim(const Vec3& aim, const Vec3& along) {
  const LampAxes level = AxesOfAim(aim);
  const Vec3 square = along - level.aim * Dot(along, level.aim);
  const double length = Length(square);
  if (!(length > 1e-9)) return level;
  const Vec3 right = square * (1.0 / length);
  return {right, Cross(right, level.aim), level.aim};
}

}  // namespace lightcal
