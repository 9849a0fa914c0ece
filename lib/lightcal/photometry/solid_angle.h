// SPDX-License-Identifier: Apache-2.0
// Solid angles without 1 - cos: that difference loses every digit for a narrow cone (at a half
// angle of 1e-8 rad it is 0 in double precision, the truth is 3.1e-16 sr).
#pragma once

#include "lightcal/core/units.h"

namespace lightcal {

// Solid angle of a cone by its half angle t:  Omega = 2 pi (1 - cos t) = 4 pi sin^2(t/2).
// Holds for 0 <= t <= pi (pi = the whole sphere, 4 pi sr).
[[nodiscard]] Steradians SolidAngleOfCone(Radians half_angle);
// Its inverse, t = 2 asin sqrt(Omega/4 pi).   Holds for 0 <= Omega <= 4 pi.
[[nodiscard]] Radians ConeHalfAngleFromSolidAngle(Steradians solid_angle);

// Solid angle between two cones about one axis, half angles inner <= outer:
//   Omega = 2 pi (cos a - cos b) = 4 pi sin((a+b)/2) sin((b-a)/2)
[[nodiscard]] Steradians SolidAngleOfZone(Radians inner, Radians outer);

// Cone angles are half angles everywhere in lightcal. Data sheets give the full apex angle.
[[nodiscard]] constexpr Radians HalfAngleFromFull(Radians full) { return full / 2.0; }
[[nodiscard]] constexpr Radians FullAngleFromHalf(Radians half) { return half * 2.0; }

}  // namespace lightcal
