// SPDX-License-Identifier: Apache-2.0
// Sources without size: a bare point, and light from one direction.
#pragma once

#include <cmath>

#include "lightcal/light/models/receiver.h"

namespace lightcal {

//   E/I = max(0, cr)/d^2,  cr = -n.p/d, the same toward every direction          [lx/cd]
// Holds for d > 0; a receiver at the source gets 0, which no meter reads.
template <class T>
[[nodiscard]] T PointLuxPerCandela(const Receiver<T>& at) {
  using std::sqrt;
  const T toward = -Dot(at.normal, at.position);
  const T d2 = Dot(at.position, at.position);
  if (!(toward > Scalar<T>(0)) || !(d2 > Scalar<T>(0))) return T(0);
  return toward / (d2 * sqrt(d2));
}

//   E/E_perp = max(0, n.l), l the unit direction toward the light.
template <class T>
[[nodiscard]] T DirectionalFactor(const Vec3Of<T>& normal, const Vec3Of<T>& toward_light) {
  const T cosine = Dot(normal, toward_light);
  return cosine > Scalar<T>(0) ? cosine : T(0);
}

}  // namespace lightcal
