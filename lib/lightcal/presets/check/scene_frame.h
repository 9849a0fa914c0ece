// SPDX-License-Identifier: Apache-2.0
// Places within places: what a scene's nodes make of those below them.
#pragma once

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "lightcal/core/vec3.h"

namespace lightcal {

inline constexpr std::size_t kDeepestNode = 1000;

// An affine transform by its columns: p -> x p0 + y p1 + z p2 + origin.
struct SceneFrame {
  Vec3 x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0};
  Vec3 origin{};

  [[nodiscard]] Vec3 Turned(const Vec3& v) const { return x * v[0] + y * v[1] + z * v[2]; }
};

// Of what hangs at `own` in a frame that hangs at `parent`.
[[nodiscard]] inline SceneFrame Within(const SceneFrame& parent, const SceneFrame& own) {
  return {parent.Turned(own.x), parent.Turned(own.y), parent.Turned(own.z),
          parent.Turned(own.origin) + parent.origin};
}

// A direction of it without the scale on the way there. Throws where nothing is left of it.
[[nodiscard]] inline Vec3 UnitAlong(const std::string& name, const Vec3& v) {
  const double length = Length(v);
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw std::runtime_error(name + ": is scaled to nothing");
  }
  return v * (1.0 / length);
}

// v turned by the quaternion (axis sin(half), cos(half)).
[[nodiscard]] inline Vec3 TurnedBy(const Vec3& axis, double w, const Vec3& v) {
  const Vec3 twice = Cross(axis, v) * 2.0;
  return v + twice * w + Cross(axis, twice);
}

[[nodiscard]] inline SceneFrame FrameTurnedBy(const Vec3& axis, double w) {
  const SceneFrame level;
  return {TurnedBy(axis, w, level.x), TurnedBy(axis, w, level.y), TurnedBy(axis, w, level.z), {}};
}

}  // namespace lightcal
