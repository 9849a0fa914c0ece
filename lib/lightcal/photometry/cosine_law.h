// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"

namespace lightcal {

// Cosine of incidence on a surface of unit normal n under light that travels along the unit
// direction `light_travel` (from the lamp to the surface, the way a lamp's aim points):
//   cr = -n . light_travel
// Negative when the light comes from behind the surface. Engines call this direction or its
// opposite "lightDirection"; here the name says which way it points.
[[nodiscard]] constexpr double CosIncidence(const Vec3& normal, const Vec3& light_travel) {
  return -Dot(normal, light_travel);
}

// Illuminance of a plane from the illuminance E_perp of a plane that faces the light:
//   E = E_perp max(0, cr)                                            [lx]
// E_perp is an illuminance, not a luminance.
// Source: CIE e-ILV, "cosine law of incidence".   Fails: never.
[[nodiscard]] constexpr Lux LuxOnTiltedPlane(Lux perpendicular, double cos_incidence) {
  return cos_incidence > 0.0 ? perpendicular * cos_incidence : Lux(0.0);
}

}  // namespace lightcal
