// SPDX-License-Identifier: Apache-2.0
// A light made ready for the colour-rendering metrics (cri.h, color_fidelity.h): its exact CCT, and
// its power carried to the wavelengths of the sample tables.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal {

// Every metric is summed over 380-780 nm in steps of 1 nm (CIE 224:2017 5.3).
inline constexpr int kRenderingFirstNm = 380;
inline constexpr int kRenderingLastNm = 780;
inline constexpr int kRenderingCount = kRenderingLastNm - kRenderingFirstNm + 1;

// Relative power at each whole nanometre of 380-780 nm, the largest sample 1.
using NanometrePowers = std::array<double, kRenderingCount>;

// Tables go to the instrument's grid, as in XyzFromSpectrum: a table value between two whole
// nanometres is linear between them, so a sample's power is shared out to both neighbours
// (p_k += S (1 - t), p_k+1 += S t) and one sum over whole nanometres serves every table. A 5 nm
// spectrum so becomes the plain 5 nm sum, not its interpolation to 1 nm; the two differ by 0.1 in
// Rf for a fluorescent lamp. Unequal steps: linear between samples, trapezoids as in
// XyzFromSpectrum.
struct RenderingInput {
  CctResult color;
  NanometrePowers powers{};
  // Where a smooth reference light is sampled, so that both lights suffer the same range and step.
  std::vector<double> reference_nm;
};

// Refused: "bad_spectrum" as XyzFromSpectrum; "truncated_spectrum" when the samples do not reach
// over 400-700 nm; "coarse_spectrum" when equal steps are wider than 20 nm; "no_reference" when the
// light has no valid CCT or one above 25000 K, where CIE daylight ends; "noisy_spectrum" when
// negative samples take back more than a tenth of the light (10-degree Y).
[[nodiscard]] Result<RenderingInput> PrepareRendering(const Spectrum& spectrum);

// The powers of a light of any colour. Refused as PrepareRendering, but for no_reference.
[[nodiscard]] Result<NanometrePowers> NanometrePowersOf(const Spectrum& spectrum);

// Power of a reference light given at input.reference_nm, shared out like the light's own.
[[nodiscard]] NanometrePowers ReferencePowers(const RenderingInput& input,
                                              std::span<const double> values);

// Black body and CIE daylight (weights unrounded) at given wavelengths, 1 at 560 nm. Hold for
// T > 0 and 4000-25000 K.
[[nodiscard]] std::vector<double> BlackBodyAt(Kelvin temperature, std::span<const double> nm);
[[nodiscard]] std::vector<double> DaylightAt(Kelvin temperature, std::span<const double> nm);

}  // namespace lightcal
