// SPDX-License-Identifier: Apache-2.0
// What other programs mean by a colour temperature. Approximations all: for a measurement take
// cct.h; these say what a program will make of a number, or what it would read.
#pragma once

#include <optional>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/units.h"

namespace lightcal {

// Krystek's rational fit of the Planckian locus,
//   u = (0.860117757 + 1.54118254e-4 T + 1.28641212e-7 T^2)
//       / (1 + 8.42420235e-4 T + 7.08145163e-7 T^2)
//   v = (0.317398726 + 4.22806245e-5 T + 4.20481691e-8 T^2)
//       / (1 - 2.89741816e-5 T + 1.61456053e-7 T^2)
// Within 1.4e-4 of the locus (CIE 1960) for 1000-15000 K, 74 K at the hot end.
// Source: Krystek, Color Res. Appl. 10, 38 (1985).
[[nodiscard]] Uv1960 KrystekUv(Kelvin temperature);

// The linear Rec. 709 colour an engine multiplies its light with.
//   Krystek, Y = 1, T clamped to 1000-15000 K. Not clamped at zero.
[[nodiscard]] Rgb KrystekRgbAtUnitY(Kelvin temperature);
//   Krystek, negative components to 0, then divided by the greatest, so a light loses
//   brightness with its colour (0.95 stop at 2700 K). The same range is clamped.
[[nodiscard]] Rgb KrystekRgbAtUnitPeak(Kelvin temperature);
//   Y = 1 on the exact locus, negative components to 0: black-body nodes to 3e-3, and those
//   that interpolate a table (1000-10000 K).
[[nodiscard]] Rgb PlanckianRgbAtUnitY(Kelvin temperature);

// The Kelvin setting with which an engine of Krystek's locus comes nearest (CIE 1960) to a colour.
// Found within 1000-15000 K; absent when the nearest lies at an end.
[[nodiscard]] std::optional<Kelvin> KrystekKelvinFrom(Uv1960 color);

// Temperature and tint as Adobe's raw converters show them: Robertson's 31 isotherms, linear
// between them in mireds; tint = -3000 times the signed distance in CIE 1960 uv, so a green light
// reads negative. The isotherms come from the exact locus: the software development kit's table
// prints u = 0.24702 for 0.24792 at 325 mired and is 23 K off near 3100 K; that misprint is
// corrected here. Holds from 1667 K; absent below, and where there is no CCT.
struct AdobeReadout {
  Kelvin temperature{0.0};
  double tint = 0.0;
};
[[nodiscard]] std::optional<AdobeReadout> AdobeReadoutFrom(Uv1960 color);

}  // namespace lightcal
