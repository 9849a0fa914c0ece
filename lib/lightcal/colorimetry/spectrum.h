// SPDX-License-Identifier: Apache-2.0
// A sampled spectral distribution on its instrument's own wavelength grid.
#pragma once

#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal {

// What one sample means.
enum class SpectralQuantity {
  kIrradiance,  // values are W m^-2 nm^-1
  kRelative,    // any scale: chromaticity only, never lux
};

// Samples at strictly increasing wavelengths (nm) above 0, equal or unequal steps, at least two,
// all finite.
struct Spectrum {
  std::vector<double> wavelengths_nm;
  std::vector<double> values;
  SpectralQuantity quantity = SpectralQuantity::kRelative;
};

// K_m in lm/W: 683 lm/W is exact at 540 THz (555.016 nm in air), a little beside the peak of V(l),
// so the factor before V, which is 1 at its peak, is 683.002.  Source: CIE 018:2019.
inline constexpr double kMaximumLuminousEfficacy = 683.002;

// CIE 1931 2-degree colour-matching functions at any wavelength: CIE's 1 nm table, linear between
// its rows, zero outside 360-830 nm (the table ends there, by less than 2e-5 of the sum).
// Components are x bar, y bar, z bar.   Source: CIE 018:2019, DOI 10.25039/CIE.DS.xvudnb9b.
[[nodiscard]] Xyz ColorMatchingAt(Nanometres wavelength);

// CIE 1931 2-degree tristimulus values of a spectrum,
//   X = K sum S(l) xbar(l) dl, ...  K = 683.002 lm/W for an irradiance, so that Y is illuminance in
//   lx; for a relative spectrum K normalises to Y = 100.
// The colour-matching functions go to the instrument's grid, never the spectrum to theirs:
//   equal steps (within 0.1 %, as rounded wavelengths are): the plain sum CIE 15:2018 7.1
//   prescribes,
//     every sample, the ends too, standing for one whole step;
//   unequal steps (IES TM-27 lists lines and plateaus, gaps of 20 nm and more): the spectrum is
//   linear
//     between its samples and the product is integrated by trapezoids over the samples' and the
//     table's wavelengths together, so that a wide gap still meets every row of the table.
// Nothing is extrapolated: a spectrum that ends inside 380-780 nm loses what lies outside it (black
// body of 6504 K read over 400-700 nm: -10.6 K); see CoversVisibleRange. Fails:
// refused/"bad_spectrum" (fewer than two samples, not increasing from above 0, not finite, sum
// <= 0).
[[nodiscard]] Result<Xyz> XyzFromSpectrum(const Spectrum& spectrum);

// Whether the samples reach over 380-780 nm, the range CIE 15:2018 7.1 still allows (half a step of
// tolerance at each end). Outside it up to 8 K are lost at 10000 K.
[[nodiscard]] bool CoversVisibleRange(const Spectrum& spectrum);

// Whether all steps are the same within 0.1 %, as rounded wavelengths are.
[[nodiscard]] bool HasEqualSteps(const Spectrum& spectrum);

// Luminous efficacy of radiation, over the spectrum's own range,
//   LER = 683.002 lm/W  sum S V dl / sum S dl.
// Source: CIE S 017:2020 (e-ILV) 17-21-090.   Fails as XyzFromSpectrum.
[[nodiscard]] Result<LumensPerWatt> EfficacyOfRadiation(const Spectrum& spectrum);

// Melanopic daylight (D65) efficacy ratio: what the light does to the cells that set the body
// clock, against what daylight of the same illuminance does,
//   DER = (sum S s_mel dl / (683.002 lm/W sum S V dl)) / 1.3262 mW/lm,
// summed as XyzFromSpectrum. 1 for D65; its melanopic equivalent daylight illuminance is E_v DER.
// Source: CIE S 026:2018, 3.9 and 3.10; 1.3262 mW/lm: its table 3.
// Fails as XyzFromSpectrum, and where noise makes the melanopic sum negative.
[[nodiscard]] Result<double> MelanopicDaylightEfficacyRatio(const Spectrum& spectrum);

}  // namespace lightcal
