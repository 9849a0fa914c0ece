// SPDX-License-Identifier: Apache-2.0
// The CIE's published tables, (c) CIE, CC BY-SA 4.0: see LICENSE here.
#pragma once

#include <array>

namespace lightcal {

// CIE 1931 2-degree colour-matching functions, 360-830 nm in steps of 1 nm.
// Source: CIE 018:2019, DOI 10.25039/CIE.DS.xvudnb9b.
inline constexpr int kCmfFirstNm = 360;
inline constexpr int kCmfLastNm = 830;
inline constexpr int kCmfCount = kCmfLastNm - kCmfFirstNm + 1;
struct CmfRow {
  double x_bar, y_bar, z_bar;
};
[[nodiscard]] const std::array<CmfRow, kCmfCount>& Cie1931Cmf();

// Components of CIE daylight, 300-830 nm in steps of 5 nm. The odd rows are the CIE's own linear
// interpolation of its 10 nm table.  Source: CIE 15:2018, table 6.
inline constexpr int kDaylightFirstNm = 300;
inline constexpr int kDaylightStepNm = 5;
inline constexpr int kDaylightCount = 107;
struct DaylightComponentRow {
  double s0, s1, s2;
};
[[nodiscard]] const std::array<DaylightComponentRow, kDaylightCount>& CieDaylightComponents();

}  // namespace lightcal
