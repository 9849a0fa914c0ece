// SPDX-License-Identifier: Apache-2.0
// The angular profiles of engines' spots as templates: for numbers and for automatic
// differentiation.
#pragma once

#include <cmath>

#include "lightcal/core/vec3.h"
#include "lightcal/photometry/spot_cone.h"

namespace lightcal {

// Angles enter as s = sin^2(theta/2) = (1 - cos theta)/2, in which differences of cosines keep
// their digits however narrow the cone.
template <class T>
[[nodiscard]] T HalfVersine(const T& angle) {
  using std::sin;
  const T half_sine = sin(angle * T(0.5));
  return half_sine * half_sine;
}
// Of the angle between +z and v: rho^2/(2 r (r + z)), rho across z.
template <class T>
[[nodiscard]] T HalfVersine(const Vec3Of<T>& v) {
  using std::sqrt;
  const T across2 = v[0] * v[0] + v[1] * v[1];
  const T r = sqrt(across2 + v[2] * v[2]);
  return v[2] > T(0) ? T(across2 / (T(2) * r * (r + v[2]))) : T((r - v[2]) / (T(2) * r));
}

// Relative intensity f, 0..1, with t = clamp((s_o - s)/(s_o - s_i), 0, 1):
//   hard 1 inside outer; linear t; squared linear t^2; smoothstep t^2 (3 - 2t).
// Blender's spot of blend b is smoothstep with s_i = (1 - b) s_o (Cycles light/spot.h).
template <class T>
[[nodiscard]] T SpotProfile(const T& s, const T& s_inner, const T& s_outer, SpotFalloff falloff) {
  if (s > s_outer) return T(0);
  if (falloff == SpotFalloff::kHard || !(s > s_inner)) return T(1);
  const T t = (s_outer - s) / (s_outer - s_inner);
  if (falloff == SpotFalloff::kLinear) return t;
  return falloff == SpotFalloff::kSquaredLinear ? T(t * t) : T(t * t * (T(3) - T(2) * t));
}

}  // namespace lightcal
