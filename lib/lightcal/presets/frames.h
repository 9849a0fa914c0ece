// SPDX-License-Identifier: Apache-2.0
// Where the objects of a preset stand: axes of lights, cards and the camera that look along -Z.
#pragma once

#include <array>

#include "lightcal/presets/engine_axes.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/rig.h"

namespace lightcal {

// Unit axes and origin in the engine's axes; x right, y up, z back (lights and cameras look along
// -z; a card faces +z). Mirrored engines get mirrored axes.
struct ObjectFrame {
  Vec3 x{}, y{}, z{}, origin{};
};

[[nodiscard]] inline ObjectFrame FrameIn(EngineAxes axes, const Vec3& x, const Vec3& y,
                                         const Vec3& z, const Vec3& origin_m) {
  return {DirectionIn(axes, x), DirectionIn(axes, y), DirectionIn(axes, z),
          PositionIn(axes, origin_m)};
}
[[nodiscard]] inline ObjectFrame FrameOfLight(EngineAxes axes, const PresetLight& light) {
  return FrameIn(axes, light.axes.c0, light.axes.c90, light.axes.aim * -1.0, light.position_m());
}
[[nodiscard]] inline ObjectFrame FrameOfCard(EngineAxes axes, const Rig& rig, const RigCard& card) {
  return FrameIn(axes, rig.row, Cross(rig.normal, rig.row), rig.normal, card.centre_m);
}
[[nodiscard]] inline ObjectFrame FrameOfCamera(EngineAxes axes, const RigCamera& camera) {
  const Vec3 from_target = camera.position_m - camera.target_m;
  const Vec3 back = from_target * (1.0 / Length(from_target));
  return FrameIn(axes, Cross(camera.up, back), camera.up, back, camera.position_m);
}

}  // namespace lightcal
