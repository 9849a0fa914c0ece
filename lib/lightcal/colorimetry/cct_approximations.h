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

// T = A0 + sum A_i exp(-n/t_i), n = (x - 0.3366)/(y - 0.1735), K, for 3000 to 50 000 K near the
// locus (some kelvins within).   Source: Hernandez-Andres, Lee, Romero, Appl. Opt. 38, 5703 (1999).
[[nodiscard]] Kelvin HernandezAndresCct(Xy xy);
// T = 449 n^3 + 3525 n^2 + 6823.3 n + 5520.33, n = (x - 0.3320)/(0.1858 - y), K, for 2856 to 6500 K
// within 2 K on the locus.   Source: McCamy, Color Res. Appl. 17, 142 (1992).
[[nodiscard]] Kelvin McCamyCct(Xy xy);

// The temperature by `method`, Duv as the signed distance to the locus there, and the status of
// CctFromXy judged by these.
[[nodiscard]] CctResult CctFromXy(Xy xy, CctMethod method);

}  // namespace lightcal
