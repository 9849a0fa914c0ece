// SPDX-License-Identifier: Apache-2.0
// Lambertian emitters and reflectors. Symbols: L luminance [cd/m^2], M luminous exitance [lm/m^2],
// E illuminance [lx], rho reflectance (0..1), A area [m^2], I0 intensity along the normal [cd].
#pragma once

#include <numbers>

#include "lightcal/core/units.h"

namespace lightcal {

// M = pi L for a surface of the same luminance in every direction.   Source: CIE e-ILV, terms
// "luminous exitance" and "Lambertian surface".
[[nodiscard]] constexpr LumensPerSquareMetre ExitanceFromLuminance(Nits l) {
  return LumensPerSquareMetre(std::numbers::pi * l.value());
}

// Exitance of a lit surface, M = rho E; its luminance where the surface is matt, L = rho E/pi.
// Holds for 0 <= rho <= 1.   Source: CIE e-ILV, "reflectance" and "Lambertian surface".
[[nodiscard]] constexpr LumensPerSquareMetre ExitanceOfLitSurface(Lux e, double reflectance) {
  return LumensPerSquareMetre(reflectance * e.value());
}
[[nodiscard]] constexpr Nits LuminanceOfLitSurface(Lux e, double reflectance) {
  return Nits(ExitanceOfLitSurface(e, reflectance).value() / std::numbers::pi);
}

// What one small solid angle d omega of incident luminance adds to the luminance a surface sends to
// the eye:  dL_out = f L_in cos(theta_in) d omega_in,  f the BRDF [1/sr], rho/pi for a matt
// surface. The cosine is that of the incident direction, not of the outgoing one.
// Source: Nicodemus et al., NBS Monograph 160 (1977).   Light from behind adds nothing.
[[nodiscard]] constexpr Nits LuminanceReflectedFrom(double brdf_per_sr, Nits incident,
                                                    double cos_incident, Steradians solid_angle) {
  if (cos_incident <= 0.0) return Nits(0.0);
  return incident * (brdf_per_sr * cos_incident * solid_angle.value());
}

// Luminance from the flux in an element of area and solid angle, the second-order derivative
//   L = d^2 Phi / (dA cos(theta) d omega)
// Source: CIE e-ILV, "luminance". The flux shrinks with both elements. Holds for dA, cos, d omega >
// 0.
[[nodiscard]] constexpr Nits LuminanceFromFluxElement(Lumens flux, SquareMetres area,
                                                      double cos_angle, Steradians solid_angle) {
  return Nits(flux.value() / (area.value() * cos_angle * solid_angle.value()));
}

// A flat Lambertian source: I0 = L A, I(theta) = I0 max(0, cos theta), Phi = pi I0 = pi L A.
[[nodiscard]] constexpr Candela AxialCandelaOfFlatSource(Nits l, SquareMetres area) {
  return Candela(l.value() * area.value());
}
[[nodiscard]] constexpr Candela CandelaOfFlatSource(Candela axial, double cos_angle) {
  return cos_angle > 0.0 ? axial * cos_angle : Candela(0.0);
}
[[nodiscard]] constexpr Lumens FluxOfFlatSource(Candela axial) {
  return Lumens(std::numbers::pi * axial.value());
}
[[nodiscard]] constexpr Candela AxialCandelaOfFlatSource(Lumens flux) {
  return Candela(flux.value() / std::numbers::pi);
}

// Illuminance under a dome of uniform luminance: E = pi L.
[[nodiscard]] constexpr Lux LuxUnderUniformDome(Nits l) {
  return Lux(std::numbers::pi * l.value());
}

}  // namespace lightcal
