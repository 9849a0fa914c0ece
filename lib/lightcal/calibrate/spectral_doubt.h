// SPDX-License-Identifier: Apache-2.0
// What the sampling, the gaps and the range of a spectrum's file leave open of its colour.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lightcal/colorimetry/spectral_error.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// Half of the 95 % intervals that it adds.
struct SpectralDoubt {
  Mireds mireds{0.0};
  double duv = 0.0;
};

// What one sample of a file of that format (ImportedFile::format) stands for: an instrument's own
// holds means over its step; of a table nobody knows it.
[[nodiscard]] Sampling SamplingOfFormat(std::string_view format);

// spectrum_truncated: it ends inside 380-780 nm.
[[nodiscard]] std::optional<Warning> WarningOfRange(const Spectrum& spectrum,
                                                    const std::string& subject);
// spectrum_clipped: samples one after the other share the largest value, more than a smooth peak of
// the file's steps has there: as far beside them as they are half wide it has fallen by twenty
// steps and 3 %. Nothing of light that is as flat at an end (illuminant E), or falls to nothing at
// once.
[[nodiscard]] std::optional<Warning> WarningOfClip(const Spectrum& spectrum,
                                                   const std::string& subject);
// undersampled: lines between samples, or the light in a gap, may be lost; with what to do.
[[nodiscard]] std::optional<Warning> WarningOfSampling(const Spectrum& spectrum,
                                                       const SpectralError& error,
                                                       const std::string& subject,
                                                       std::string_view remedy);

// The bound of SpectralErrorOf; across a gap that of means over the steps, the gap's too, though
// lines may shine there. Where the steps are even and lines may be lost between them, six times
// what it would be of means over the steps, and at least 8 mired and 0.0033 for each nm of an even
// step: what is usual of lamps with lines, no bound. (Of 39 random ones of two to five lines 0.6 to
// 3 nm wide it holds 87, 86 and 100 % of their CCTs at 3, 5 and 10 nm, 90, 95 and 100 % of their
// Duv.) Nothing where there is no CCT.
[[nodiscard]] SpectralDoubt DoubtOf(const Spectrum& spectrum, const SpectralError& error);

// Adds it, independent of the rest, to the lamp's CCT and Duv.
void WidenBy(const SpectralDoubt& doubt, FittedColor& color);

}  // namespace lightcal
