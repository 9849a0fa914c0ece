// SPDX-License-Identifier: Apache-2.0
// A sampled spectral distribution on its instrument's own wavelength grid.
#pragma once

#include <optional>
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

// Samples at strictly increasing wavelengths (nm), equal or unequal steps, at least two, all finite.
struct Spectrum {
  std::vector<double> wavelengths_nm;
  std::vector<double> values;
  SpectralQuantity quantity = SpectralQuantity::kRelative;
};

// CIE 1931 2-degree tristimulus values of a spectrum,
//   X = K sum S(l) xbar(l) dl, ...  K = 683.002 lm/W for an irradiance, so that Y is illuminance in lx;
//   for a relative spectrum K normalises to Y = 100.
// The colour matching functions (CIE 018:2019 table, 1 nm, 360-830 nm) are interpolated linearly to
// the instrument's grid, never the spectrum to theirs; dl is the width of each sample's own bin
// (half way to its neighbours; an end sample gets a full step of its neighbouring interval on a
// uniform grid, so a uniform grid is the plain sum CIE 15 prescribes).
// Fails: refused/"bad_spectrum" (fewer than two samples, not increasing, not finite, sum <= 0).
[[nodiscard]] Result<Xyz> XyzFromSpectrum(const Spectrum& spectrum);

}  // namespace lightcal
