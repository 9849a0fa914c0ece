// SPDX-License-Identifier: Apache-2.0
// The Planckian (black-body) locus, exact: CIE 1931 2-degree colour-matching functions, plain sum
// 360-830 nm in 1 nm steps, c2 = 1.4388e-2 m K (the value CCT is defined with, CIE 15:2018 9.4),
// refractive index 1.
#pragma once

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/units.h"

namespace lightcal {

// Second radiation constant of the CCT definition. Chromaticity depends on c2/T alone: another c2
// rescales T and nothing else (1.435e-2, illuminant A's, is 0.2648 % lower).
inline constexpr double kC2MetreKelvin = 1.4388e-2;
// The same of illuminant A (CIE 15:2018 4.1.1) and of the nominal daylight temperatures.
inline constexpr double kC2OfIlluminantAMetreKelvin = 1.435e-2;
inline constexpr double kC2OfDaylightNamesMetreKelvin = 1.4380e-2;

// g(x) = x/(exp(x) - 1) = x/expm1(x), with g(0) = 1: what is left of Planck's law once its
// wavelength power is taken out,
//   M(l, T) ~ l^-5 / (exp(x) - 1) ~ T l^-4 g(x),   x = c2/(l T).
// Finite for every x >= 0, so a temperature of infinity (x = 0) is an ordinary value.
[[nodiscard]] double PlanckRatio(double x);

// A point of the locus with its first two derivatives by mireds. Speed |d(u,v)/dmired| is nearly
// constant (3.2e-4 to 3.7e-4 from 2000 to 20000 K): fit in mireds, never in kelvins.
struct LocusPoint {
  Uv1960 uv;
  double du = 0.0, dv = 0.0;    // d(u,v)/dmired
  double d2u = 0.0, d2v = 0.0;  // d2(u,v)/dmired2
};
// Holds for 0 <= reciprocal < infinity; 0 is T = infinity: (0.18006436, 0.26352122).
[[nodiscard]] LocusPoint PlanckianLocusAt(Mireds reciprocal_temperature);

// Colour of the black body at temperature T > 0 (infinity allowed), scaled to Y = 1.
[[nodiscard]] Xyz PlanckianXyz(Kelvin temperature);

}  // namespace lightcal
