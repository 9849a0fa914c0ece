// SPDX-License-Identifier: Apache-2.0
// From our axes (right-handed, Z up, metres) to those engines use.
#pragma once

#include <cstdint>

#include "lightcal/core/vec3.h"

namespace lightcal {

enum class EngineAxes : std::uint8_t {
  kZUp,     // ours: Blender, Mitsuba, PBRT, USD with upAxis "Z"
  kYUp,     // right-handed, Y up, metres: glTF, three.js, Filament, Godot
  kUnreal,  // left-handed, Z up, centimetres; lights and cameras look along +X
  kUnity,   // left-handed, Y up, metres; lights and cameras look along +Z
};

//   kYUp     (x, y, z) -> (x, z, -y)      -90 degrees about X
//   kUnreal  (x, y, z) -> (x, -y, z)      mirrored
//   kUnity   (x, y, z) -> (x, z, y)       mirrored
[[nodiscard]] constexpr Vec3 DirectionIn(EngineAxes axes, const Vec3& v) {
  switch (axes) {
    case EngineAxes::kYUp:
      return {v[0], v[2], 0.0 - v[1]};
    case EngineAxes::kUnreal:
      return {v[0], 0.0 - v[1], v[2]};
    case EngineAxes::kUnity:
      return {v[0], v[2], v[1]};
    case EngineAxes::kZUp:
      break;
  }
  return v;
}

// The engine's own unit per metre.
[[nodiscard]] constexpr double UnitsPerMetre(EngineAxes axes) {
  return axes == EngineAxes::kUnreal ? 100.0 : 1.0;
}
[[nodiscard]] constexpr Vec3 PositionIn(EngineAxes axes, const Vec3& metres) {
  return DirectionIn(axes, metres) * UnitsPerMetre(axes);
}

// Unreal's FRotator [degrees] of the object whose forward (+X), right (+Y) and up (+Z) axes point
// along these unit vectors of Unreal's world:
//   forward = (cos p cos y, cos p sin y, sin p),  right_z = -sin r cos p,  up_z = cos r cos p
// Straight up or down (cos p = 0) takes yaw 0.   Source: FRotationMatrix of the engine's API.
struct UnrealRotator {
  double pitch_deg = 0.0, yaw_deg = 0.0, roll_deg = 0.0;
};
[[nodiscard]] UnrealRotator UnrealRotatorFromAxes(const Vec3& forward, const Vec3& right,
                                                  const Vec3& up);

}  // namespace lightcal
