// SPDX-License-Identifier: Apache-2.0
// Illuminance that a uniform Lambertian source casts on a receiver facing it on its axis, in closed
// form at every distance; far away each tends to I/d^2. Per nit of luminance [lx / (cd/m^2)].
// Receivers elsewhere or tilted are the light room's matter.
#pragma once

#include "lightcal/core/units.h"

namespace lightcal {

// pi R^2/d^2, d to the centre, d > R: a sphere obeys the inverse square law exactly.
[[nodiscard]] double LuxPerNitOfSphere(Metres radius, Metres distance);
// pi R^2/(R^2 + d^2).
[[nodiscard]] double LuxPerNitOfDisk(Metres radius, Metres distance);
// With half sides a, b and A = sqrt(a^2 + d^2), B = sqrt(b^2 + d^2):
//   2 [ (a/A) atan(b/A) + (b/B) atan(a/B) ]
// Source: Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-4, four times.
[[nodiscard]] double LuxPerNitOfRect(Metres width, Metres height, Metres distance);
// A rectangle's limit as its other side goes to 0, per candela of axial intensity [lx/cd], t half
// its length:
//   1/2 [ 1/(d^2 + t^2) + atan(t/d)/(t d) ]
[[nodiscard]] double LuxPerCandelaOfLine(Metres length, Metres distance);
// A cylinder's mantle (ends dark) of radius R and length l, seen square on from distance d > R
// between the axis and the receiver: twice the factor of half the length. With L = l/2R, H = d/R,
// X = (1 + H)^2 + L^2, Y = (1 - H)^2 + L^2:
//   2 { atan(L/sqrt(H^2-1))/H + L [ (X-2H)/(H sqrt(XY)) atan sqrt(X(H-1)/(Y(H+1)))
//                                   - (1/H) atan sqrt((H-1)/(H+1)) ] }
// Source: Siegel & Howell, Thermal Radiation Heat Transfer, plane element to right circular
// cylinder; evaluated without its cancellation, so it holds from touching to any distance.
[[nodiscard]] double LuxPerNitOfTube(Metres length, Metres radius, Metres distance);

}  // namespace lightcal
