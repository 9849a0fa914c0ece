// SPDX-License-Identifier: Apache-2.0
// CIE 224 colour fidelity index, and ANSI/IES TM-30's gamut and hue bins over the same 99 samples.
#pragma once

#include <array>

#include "lightcal/colorimetry/cam02_ucs.h"
#include "lightcal/colorimetry/rendering_input.h"
#include "lightcal/core/units.h"

namespace lightcal {

inline constexpr int kFidelitySampleCount = 99;
inline constexpr int kHueBinCount = 16;

// What two editions of one metric differ in.
struct FidelityEdition {
  double scale = 0.0;                          // of the mean colour difference
  Kelvin last_black_body{}, first_daylight{};  // the reference is mixed between them
};
// CIE 224:2017, and TM-30 since its 2018 edition.
inline constexpr FidelityEdition kCie224{6.73, Kelvin(4000.0), Kelvin(5000.0)};
// IES TM-30-15, which meters of its time still show: Rf is up to 5.5 lower.
inline constexpr FidelityEdition kTm30Of2015{7.54, Kelvin(4500.0), Kelvin(5500.0)};

// The 99 samples under the light and under its reference in CAM02-UCS, 10-degree observer.
//   Rf = 10 ln(1 + exp((100 - 6.73 mean dE)/10)),   Rf_i the same of dE_i
// Reference: black body of the light's exact CCT below 4000 K, CIE daylight above 5000 K, between
// them both, each scaled to equal Y of the 10-degree observer and mixed linearly in T.
// Source: CIE 224:2017 (Rf equals TM-30's).
struct ColorFidelity {
  double Rf = 0.0;
  double scale = 0.0;  // 6.73 in CIE 224
  std::array<double, kFidelitySampleCount> sample_Rf{};
  std::array<double, kFidelitySampleCount> difference{};  // dE in CAM02-UCS
  std::array<Cam02Ucs, kFidelitySampleCount> test{}, reference{};
};
[[nodiscard]] ColorFidelity ColorFidelityOf(const RenderingInput& light,
                                            const FidelityEdition& edition = kCie224);

// Samples of one 22.5-degree sector of reference hue, bin 1 beginning at h = 0, with its mean
// (a', b') under both lights. Only `samples` is set where there are none.
struct HueBin {
  int samples = 0;
  double Rf = 0.0;             // Rf,hj: from the bin's mean dE
  double chroma_shift = 0.0;   // Rcs,hj: 0.1 = 10 % more chroma
  double hue_shift_rad = 0.0;  // Rhs,hj
  double test_a = 0.0, test_b = 0.0;
  double reference_a = 0.0, reference_b = 0.0;
};

//   Rg = 100 A_test / A_reference of the polygons of the bins' means.
// A bin without samples (only possible for a strange reference) is left out of the polygon.
// Source: ANSI/IES TM-30-20, 4 and annex.
struct GamutAndBins {
  double Rg = 0.0;
  std::array<HueBin, kHueBinCount> bins{};
};
[[nodiscard]] GamutAndBins GamutAndBinsOf(const ColorFidelity& fidelity);

}  // namespace lightcal
