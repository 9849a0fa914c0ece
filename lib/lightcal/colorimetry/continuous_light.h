// SPDX-License-Identifier: Apache-2.0
// Lights that shine at every wavelength, told by their spectrum.
#pragma once

#include "lightcal/colorimetry/spectrum.h"

namespace lightcal {

// Whether what makes the light shine makes no lines that could hide between its samples:
//   thermal radiation and daylight: every sample is within a tenth of the greatest from the black
//     body or the CIE daylight of the light's own CCT, scaled to the same sum;
//   a white LED, in steps up to 5 nm: a pump band with its peak within 400-475 nm, at least three
//     samples and 10 nm wide at half its height, whose flank towards red comes down to half within
//     27.5 nm.
// The continuum of a fluorescent lamp whose mercury lines all fall between the samples is as smooth
// as those but neither. A mixture of such a lamp with daylight or an LED is not foreseen. False
// where the spectrum cannot be judged. Fails: never.
[[nodiscard]] bool IsContinuousLight(const Spectrum& spectrum);

}  // namespace lightcal
