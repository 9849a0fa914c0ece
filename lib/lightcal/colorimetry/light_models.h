// SPDX-License-Identifier: Apache-2.0
// Spectra of LEDs by their data sheet.
#pragma once

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal {

// One colour: S = 100 exp(-4 ln 2 ((l - peak)/fwhm)^2), 360-830 nm at 1 nm, relative.
// Holds for a peak within 360-830 nm and a full width at half maximum of 1-400 nm.
// Refused: "out_of_range".
[[nodiscard]] Result<Spectrum> GaussianSpectrum(Nanometres peak, Nanometres fwhm);

// A blue pump (455 nm, 20 nm wide) under a phosphor (peak and width given), mixed for this CCT:
// both parts are Gaussians and only their ratio is free.
// A model: its Duv is what the two colours allow, and real phosphors are skewed.
// Refused: "out_of_range" as GaussianSpectrum, and when no mixture of the two has this CCT.
[[nodiscard]] Result<Spectrum> PhosphorLedSpectrum(Kelvin temperature,
                                                   Nanometres phosphor_peak = Nanometres(580.0),
                                                   Nanometres phosphor_fwhm = Nanometres(125.0));

}  // namespace lightcal
