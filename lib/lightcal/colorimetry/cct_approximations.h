// SPDX-License-Identifier: Apache-2.0
// Colour temperature by published polynomials: what they cost in accuracy, `tradeoff` measures.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "lightcal/colorimetry/cct.h"

namespace lightcal {

// Strictest first.
enum class CctMethod : std::uint8_t { kExact, kHernandezAndres, kMcCamy };
inline constexpr std::array<std::string_view, 3> kCctMethodWords = {"exact", "hernandez_andres",
                                                                    "mccamy"};

// T = A0 + sum A_i exp(-n/t_i), n = (x - 0.3366)/(y - 0.1735), K, for 3000 to 50 000 K near
// daylight's locus. On Planck's it is 46 K low at 3000, within 25 K from 3300 to 20 000, 33 K high
// at 25 000 and 719 K (1.4 %) at 50 000.   Source: Hernandez-Andres, Lee, Romero, Appl. Opt. 38,
// 5703 (1999).
[[nodiscard]] Kelvin HernandezAndresCct(Xy xy);
// T = 449 n^3 + 3525 n^2 + 6823.3 n + 5520.33, n = (x - 0.3320)/(0.1858 - y), K, for 2856 to 6500
// K: there -1 to +10.1 K on Planck's locus, most at 3600; 20 K low at 2100, 18 at 8000, 5500 at 25
// 000.   Source: McCamy, Color Res. Appl. 17, 142 (1992).
[[nodiscard]] Kelvin McCamyCct(Xy xy);

// The temperature by `method`, Duv as the signed distance to the locus there, and the status of
// CctFromXy judged by these.
[[nodiscard]] CctResult CctFromXy(Xy xy, CctMethod method);

}  // namespace lightcal
