// SPDX-License-Identifier: Apache-2.0
// Exposures measured from pictures against their labels.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/exposure_ratios.h"
#include "lightcal/imaging/bracket/label_choices.h"

namespace lightcal {

// Of a measured exposure, whose ln is off by `off` from its label's. Refused: exposures_disagree,
// by more than 1.2 EV. Warns: exposure_off, by more than .25 EV.
[[nodiscard]] Result<void> NameOddLabel(double off, const std::string& name, Warnings& warnings);

// Gives answer.ln_exposure the labels' unit. `first[i]` is the first of the frames that
// measurements join to frame i, itself where none does. Frames so joined are off by the mean over
// most of their labels, which agree within .25 EV; the others are named (NameOddLabel). Where no
// more than half agree nobody knows which are right: the middle of all, and gauge_sd as far as
// either end; warned labels_disagree, and refused as NameOddLabel if the ends are as far apart.
[[nodiscard]] Result<void> CompareWithLabels(std::span<const double> label,
                                             std::span<const std::string> names,
                                             std::span<const std::size_t> first,
                                             ExposureRatios& answer);

// The same where a curve stands between codes and light (WeighLabels).
[[nodiscard]] Result<void> WeighCurve(std::span<const double> label,
                                      std::span<const std::string> names, const CurvePower& curve,
                                      ExposureRatios& answer);

}  // namespace lightcal
