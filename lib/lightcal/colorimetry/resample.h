// SPDX-License-Identifier: Apache-2.0
// A spectrum on another grid, by area.
#pragma once

#include <vector>

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal {

// Mean of the spectrum over count bins of width `step`, centred at first, first + step, ...
//   S'_j = 1/step  integral of S over [l_j - step/2, l_j + step/2],
// each sample of S standing for its own bin, from halfway to its neighbours (half a step beyond the
// ends). No line between two samples is lost and the power within the new range is kept to
// rounding, as picking every fifth sample would not (CIE FL10: 1476 K wrong at 5 nm).
// Refused: "bad_spectrum" as XyzFromSpectrum; "out_of_range" when a new bin reaches beyond the
// spectrum, step is not positive or count below 2.
[[nodiscard]] Result<Spectrum> ResampleByArea(const Spectrum& spectrum, Nanometres first,
                                              Nanometres step, int count);

// Bounds of the bins the samples stand for: one more than there are samples. Holds from two.
[[nodiscard]] std::vector<double> BinEdgesNm(const Spectrum& spectrum);

}  // namespace lightcal
