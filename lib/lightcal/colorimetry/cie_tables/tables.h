// SPDX-License-Identifier: Apache-2.0
// The CIE's published tables. The numbers in tables.cc are (c) CIE, CC BY-SA 4.0: see LICENSE here.
#pragma once

#include <array>

namespace lightcal {

// CIE 1931 2-degree colour-matching functions, 360-830 nm in steps of 1 nm.
// Source: CIE 018:2019, DOI 10.25039/CIE.DS.xvudnb9b.
inline constexpr int kCmfFirst_nm = 360;
inline constexpr int kCmfLast_nm = 830;
inline constexpr int kCmfCount = kCmfLast_nm - kCmfFirst_nm + 1;
struct CmfRow {
  double x_bar, y_bar, z_bar;
};
extern const std::array<CmfRow, kCmfCount> kCie1931Cmf;

// Components of CIE daylight, 300-830 nm in steps of 5 nm. The odd rows are the CIE's own linear
// interpolation of its 10 nm table.  Source: CIE 15:2018, table 6.
inline constexpr int kDaylightFirst_nm = 300;
inline constexpr int kDaylightStep_nm = 5;
inline constexpr int kDaylightCount = 107;
struct DaylightComponentRow {
  double s0, s1, s2;
};
extern const std::array<DaylightComponentRow, kDaylightCount> kDaylightComponents;

}  // namespace lightcal
