// SPDX-License-Identifier: Apache-2.0
// From our axes (right-handed, Z up, metres) to those engines use.
#pragma once

#include <cstdint>

#include "lightcal/core/vec3.h"

namespace lightcal {

enum class EngineAxes : std::uint8_t {
  kZUp,            // ours
  kYUp,            // right-handed, Y up, metres
  kZUpLeftHanded,  // centimetres; lights and cameras look along +X
  kYUpLeftHanded,  // metres; lights and cameras look along +Z
};

//   kYUp            (x, y, z) -> (x, z, -y)      -90 degrees about X
//   kZUpLeftHanded  (x, y, z) -> (x, -y, z)      mirrored
//   kYUpLeftHanded  (x, y, z) -> (x, z, y)       mirrored
[[nodiscard]] constexpr Vec3 DirectionIn(EngineAxes axes, const Vec3& v) {
  switch (axes) {
    case EngineAxes::kYUp:
      return {v[0], v[2], 0.0 - v[1]};
    case EngineAxes::kZUpLeftHanded:
      return {v[0], 0.0 - v[1], v[2]};
    case EngineAxes::kYUpLeftHanded:
      return {v[0], v[2], v[1]};
    case EngineAxes::kZUp:
      break;
  }
  return v;
}

// The engine's own unit per metre.
[[nodiscard]] constexpr double UnitsPerMetre(EngineAxes axes) {
  return axes == EngineAxes::kZUpLeftHanded ? 100.0 : 1.0;
}
[[nodiscard]] constexpr Vec3 PositionIn(EngineAxes axes, const Vec3& metres) {
  return DirectionIn(axes, metres) * UnitsPerMetre(axes);
}

}  // namespace lightcal
