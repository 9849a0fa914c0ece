// SPDX-License-Identifier: Apache-2.0
// The CIE's test colour samples and the observer they are judged by, (c) CIE, CC BY-SA 4.0: see
// LICENSE here.
#pragma once

#include <array>

#include "lightcal/colorimetry/cie_tables/tables.h"

namespace lightcal {

// CIE 1964 10-degree colour-matching functions on the wavelengths of Cie1931Cmf().
// Source: CIE 018:2019, DOI 10.25039/CIE.DS.sqksu2n5.
[[nodiscard]] const std::array<CmfRow, kCmfCount>& Cie1964Cmf();

// Both sample tables come in steps of 5 nm.
inline constexpr int kSampleStepNm = 5;

// Spectral radiance factors of CIE test colour samples 1-14, 360-830 nm, and of sample 15 (Asian
// skin).  Source: CIE 13.3-1995, DOI 10.25039/CIE.DS.wuiuu9cz; sample 15: JIS Z 8726.
inline constexpr int kCriFirstNm = 360;
inline constexpr int kCriRowCount = 95;
inline constexpr int kCriSampleCount = 15;
using CriSampleRow = std::array<double, kCriSampleCount>;
[[nodiscard]] const std::array<CriSampleRow, kCriRowCount>& CriSamples();

// Spectral radiance factors of the 99 colour evaluation samples, 380-780 nm.
// Source: CIE 224:2017 (the same as ANSI/IES TM-30).
inline constexpr int kCfiFirstNm = 380;
inline constexpr int kCfiRowCount = 81;
inline constexpr int kCfiSampleCount = 99;
using CfiSampleRow = std::array<double, kCfiSampleCount>;
[[nodiscard]] const std::array<CfiSampleRow, kCfiRowCount>& CfiSamples();

}  // namespace lightcal
