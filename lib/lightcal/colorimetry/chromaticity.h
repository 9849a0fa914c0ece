// SPDX-License-Identifier: Apache-2.0
// Colour coordinates as distinct types, so that xy can never be passed for uv.
#pragma once

#include "lightcal/core/matrix3.h"

namespace lightcal {

struct Xyz {  // CIE 1931 2-degree tristimulus values
  double X = 0.0, Y = 0.0, Z = 0.0;
};
[[nodiscard]] constexpr Column3 ColumnOf(const Xyz& c) { return {c.X, c.Y, c.Z}; }
struct Xy {  // CIE 1931: x = X/(X+Y+Z), y = Y/(X+Y+Z)
  double x = 0.0, y = 0.0;
};
// What a real light may have, and a little more: no tristimulus value is negative, Y is not 0; but
// for how far off a meter of .005 reads a deep red, whose Z is 0 (0.7347, 0.2653 rounds to more than
// 1 with either digit).
[[nodiscard]] constexpr bool IsPhysicalXy(Xy c) {
  constexpr double kOffByAMeter = 0.005;
  return c.x >= 0.0 && c.y > 0.0 && c.x + c.y <= 1.0 + kOffByAMeter;
}
struct Uv1960 {  // CIE 1960 UCS, the plane in which CCT and Duv are defined
  double u = 0.0, v = 0.0;
};
struct Uv1976 {  // CIE 1976 UCS: u' = u, v' = 1.5 v
  double u = 0.0, v = 0.0;
};

// u = 4x/(-2x+12y+3), v = 6y/(-2x+12y+3).   Source: CIE 15:2018, eq. 9.31 and appendix.
// Holds where the denominator is not 0 (every real colour: it is above 1).
[[nodiscard]] constexpr Uv1960 Uv1960FromXy(Xy c) {
  const double denominator = -2.0 * c.x + 12.0 * c.y + 3.0;
  return {4.0 * c.x / denominator, 6.0 * c.y / denominator};
}
// x = 3u/(2u-8v+4), y = 2v/(2u-8v+4): the inverse of the above.
[[nodiscard]] constexpr Xy XyFromUv1960(Uv1960 c) {
  const double denominator = 2.0 * c.u - 8.0 * c.v + 4.0;
  return {3.0 * c.u / denominator, 2.0 * c.v / denominator};
}
[[nodiscard]] constexpr Uv1976 Uv1976FromXy(Xy c) {
  const Uv1960 uv = Uv1960FromXy(c);
  return {uv.u, 1.5 * uv.v};
}
// Holds for X+Y+Z > 0.
[[nodiscard]] constexpr Xy XyFromXyz(const Xyz& c) {
  const double sum = c.X + c.Y + c.Z;
  return {c.X / sum, c.Y / sum};
}
// The colour of chromaticity c with luminance factor Y = 1.  Holds for y > 0.
[[nodiscard]] constexpr Xyz XyzFromXyAtUnitY(Xy c) {
  return {c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y};
}

}  // namespace lightcal
