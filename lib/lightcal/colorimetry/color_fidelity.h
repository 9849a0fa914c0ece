// SPDX-License-Identifier: Apache-2.0
// CIE 224 colour fidelity index, and ANSI/IES TM-30's gamut and hue bins over the same 99 samples.
#pragma once

#include <array>

#include "lightcal/colorimetry/cam02_ucs.h"
#include "lightcal/colorimetry/rendering_input.h"

namespace lightcal {

inline constexpr int kFidelitySampleCount = 99;
inline constexpr int kHueBinCount = 16;

// The 99 samples under the light and under its reference in CAM02-UCS, 10-degree observer.
//   Rf = 10 ln(1 + exp((100 - 6.73 mean dE)/10)),   Rf_i the same of dE_i
// Reference: black body of the light's exact CCT below 4000 K, CIE daylight above 5000 K, between
// them both, each scaled to equal Y of the 10-degree observer and mixed linearly in T.
// Source: CIE 224:2017 (Rf equals TM-30's).
struct ColorFidelity {
  double Rf = 0.0;
  std::array<double, kFidelitySampleCount> sample_Rf{};
  std::array<double, kFidelitySampleCount> difference{};  // dE in CAM02-UCS
  std::array<Cam02Ucs, kFidelitySampleCount> test{}, reference{};
};
[[nodiscard]] ColorFidelity ColorFidelityOf(const RenderingInput& light);

// Samples of one 22.5-degree sector of reference hue, bin 1 beginning at h = 0. Its mean (a', b')
// under both lights; test_a .. scaled so that the reference lies on the unit circle at the bin's
// centre, as the colour vector graphic draws it.
struct HueBin {
  int samples = 0;
  double Rf = 0.0;                    // Rf,hj: from the bin's mean dE
  double chroma_shift = 0.0;          // Rcs,hj: 0.1 = 10 % more chroma
  double hue_shift_rad = 0.0;         // Rhs,hj
  double test_a = 0.0, test_b = 0.0;  // in J'a'b'
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
