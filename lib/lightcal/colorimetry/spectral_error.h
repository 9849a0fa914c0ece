// SPDX-License-Identifier: Apache-2.0
// How far the step and the range of a spectrum may have moved its colour.
#pragma once

#include <optional>

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal {

// What one sample stands for.
enum class Sampling {
  kUnknown,
  kBandAverage,  // the mean over its step: instruments whose bandwidth is at least their step
  kPoint,        // the value at one wavelength: a finer table, every so many rows of it
};

// Bounds of |measured - truth|, truth being the same light in 1 nm steps over 360-830 nm.
struct SpectralErrorBound {
  std::optional<Kelvin> temperature;  // with duv absent where there is no CCT, or no end to it
  std::optional<double> duv;
  double illuminance_relative = 0.0;
};

struct SpectralError {
  Nanometres first{0.0}, last{0.0}, step{0.0};  // step: the widest
  // Share of the weighted power that the samples' neighbours do not foretell; 0 for smooth light.
  double roughness = 0.0;
  bool undersampled = false;  // lines between the samples may have been missed: no bound
  std::optional<SpectralErrorBound> bound;
};

// Sum of two bounds, both carried from XYZ to mireds, Duv and Y to first order and widened to 1.6
// times.
//   Step: what the sum changes when each sample becomes a piece of a straight line or of a parabola
//     of the same area (the greater of both), plus, for the part of a sample that a cubic through
//     its neighbours does not foretell (at most all of it), its being anywhere within its step.
//   Range: light outside at up to 1.5 times the greatest sample within 15 nm of the end, growing
//     outwards as it grew inside (mirrored at the end, at most fivefold), or none.
// Bounds every black body of 1500-20000 K, CIE daylight, LED and band-averaged CIE illuminant (FL,
// FL3, HP, LED) at 1, 5, 10 nm from 360, 380, 400 to 700, 730, 780 nm; a light that begins only
// outside the range is not foreseen.
//   Undersampled: samples of one wavelength each tell nothing of the wavelengths between them.
//   Lines
//     of discharge lamps are narrower than 1 nm, in CIE's 1 nm tables one row wide, so any step
//     wider than the truth's 1 nm may hide all of them: five of CIE's 27 fluorescent lamps read
//     every 5 nm are as smooth as daylight and 200 K wrong. No rule on roughness finds them. So
//     samples of unknown or point sampling wider than 1 nm have a bound only where the light is of
//     a kind that has no lines (continuous_light.h) and is no rougher than such lights are. Over
//     all 41 CIE lamps at 2, 3, 4, 5 and 10 nm, every range and every phase of the sampling no
//     bound is wrong (tests/colorimetry/spectral_error_test.cc).
// Fails as XyzFromSpectrum.
[[nodiscard]] Result<SpectralError> SpectralErrorOf(const Spectrum& spectrum, Sampling sampling);

}  // namespace lightcal
