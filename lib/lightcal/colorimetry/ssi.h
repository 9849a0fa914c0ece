// SPDX-License-Identifier: Apache-2.0
// Spectral Similarity Index of two lights.
#pragma once

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal {

// How alike two relative spectra are, whatever camera looks on: 100 for the same shape.
//   both integrated in 30 bands of 10 nm around 380-670 nm (ends at half weight) and scaled to sum
//   1; d = (test - reference)/(reference + 1/30), times weights that fall off at both ends,
//   smoothed with 0.22 0.56 0.22;  SSI = 100 - 32 sqrt(sum d^2).
// Unrounded (the Academy prints whole numbers), and below 0 for spectra very unlike. Each spectrum
// is linear between its samples and zero outside them, as the Academy's calculator takes it.
// Source: Holm et al., "A Cinematographic Spectral Similarity Index", SMPTE 2016; SMPTE ST 2122.
// Refused: "bad_spectrum" when a spectrum cannot be read (see XyzFromSpectrum) or has no power in
// 375-675 nm.
[[nodiscard]] Result<double> SpectralSimilarity(const Spectrum& test, const Spectrum& reference);

// The light a lamp of this temperature is compared with: a black body below 4000 K, CIE daylight
// from there, 1 nm. Refused: as BlackBodySpectrum and DaylightSpectrum.
[[nodiscard]] Result<Spectrum> SimilarityReference(Kelvin temperature);

}  // namespace lightcal
