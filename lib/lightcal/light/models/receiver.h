// SPDX-License-Identifier: Apache-2.0
// Where a meter stands and how it is turned, seen from a source's own frame.
#pragma once

#include <array>
#include <cmath>

#include "lightcal/core/vec3.h"
#include "lightcal/light/lamp_axes.h"

namespace lightcal {

// The source's centre is the origin. A flat source fills the plane z = 0 and shines along +z; its
// width runs along x, its height along y; a tube's axis is x. Every model below is a template: T is
// double, float or an automatic-differentiation scalar. Lengths in any one unit.
template <class T>
struct Receiver {
  Vec3Of<T> position;
  Vec3Of<T> normal;  // unit
};

// The plain number type that constants are written in beside T.
template <class T>
struct ScalarOf {
  using type = double;
};
template <>
struct ScalarOf<float> {
  using type = float;
};
template <class T>
using Scalar = typename ScalarOf<T>::type;

// Unit directions of the source's frame in the session's.
struct SourceFrame {
  Vec3 x{1.0, 0.0, 0.0};
  Vec3 y{0.0, 1.0, 0.0};
  Vec3 z{0.0, 0.0, 1.0};

  // The same vector in the source's frame.
  template <class T>
  [[nodiscard]] Vec3Of<T> Of(const Vec3Of<T>& v) const {
    return {Dot(v, x), Dot(v, y), Dot(v, z)};
  }
  // x along `along` made square to the unit direction `z`; where that leaves nothing, horizontal as
  // AxesOfAim has it.
  [[nodiscard]] static SourceFrame Facing(const Vec3& z, const Vec3& along = {}) {
    const Vec3 square = along - z * Dot(along, z);
    const double length = Length(square);
    const Vec3 x = length > 1e-9 ? square * (1.0 / length) : AxesOfAim(z).c0;
    return {x, Cross(z, x), z};
  }
};

}  // namespace lightcal
