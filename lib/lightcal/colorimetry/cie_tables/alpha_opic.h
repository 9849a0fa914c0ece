// SPDX-License-Identifier: Apache-2.0
// The CIE's action spectrum of the cells that set the body clock, (c) CIE, CC BY-SA 4.0: see
// LICENSE here.
#pragma once

#include <array>

namespace lightcal {

// Melanopic action spectrum s_mel, 380-780 nm in steps of 1 nm, 1 at 490 nm.
// Source: CIE S 026:2018, table 2, DOI 10.25039/CIE.DS.vqqhzp5a.
inline constexpr int kMelanopicFirstNm = 380;
inline constexpr int kMelanopicCount = 401;
[[nodiscard]] const std::array<double, kMelanopicCount>& MelanopicActionSpectrum();

}  // namespace lightcal
