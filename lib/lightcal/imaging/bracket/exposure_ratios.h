// SPDX-License-Identifier: Apache-2.0
// True exposures of a bracket's frames, measured from the picture itself: shutters are labelled in
// rounded thirds of a stop (1/60 for 1/64 s) and repeat to a few per cent.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/label_choices.h"
#include "lightcal/imaging/bracket/sampled.h"

namespace lightcal {

// Of one label's ln: a third stop's rounding, a shutter's 3 %.
inline constexpr double kLabelSd = 0.04;

struct ExposureRatios {
  // ln of each frame's exposure; their mean difference to the labels is 0 over the frames that are
  // joined by measurements and agree with most of these within .25 EV, so that no single frame's
  // error becomes the scale. Where no more than half agree it is 0 in the middle of all, and
  // gauge_sd as far as either end.
  std::vector<double> ln_exposure;
  std::vector<double> sd_ln;   // of the difference to the first joined frame, from the residuals
  std::vector<bool> measured;  // false: nothing seen by this frame and another; the label stands
  // Share of the clip up to which frames agree: below 0.9 where the sensor bends earlier.
  double linear_to = 0.9;
  // Half of what the ln ratios of two parts of the picture are apart, of which nobody knows whose
  // light stayed.
  double part_sd = 0.0;
  double gauge_sd = 0.0;  // of what is common to all, ln
  double power_sd = 0.0;  // as WeighLabels has it; 0 without a curve
  Warnings warnings;      // ratio_from_label, exposure_off, labels_disagree, light_changed
};

// One number a frame, from all pairs with a common range. A pair's ratio is sum b / sum a over
// samples chosen by a + b (for shot noise the best estimate, and unbiased: given a + b, b is
// binomial), their weighted least squares gives the exposures. Samples near the clip or far from
// the bulk (motion) are left out. `label` are exposures from tags (time ISO / N^2, any unit), > 0,
// in the order of `signals`; names stand in messages.
//   accuracy: 0.05 % on 1e5 shared samples with labels wrong by up to 2 EV
// `curve`: through which codes were read. It is wrong by kLeastStatedMisfit, so that labels are
// weighed beside what is measured through it (label_choices.h).
// Refused: exposures_disagree (measured and label differ by more than 1.2 EV: frames shuffled, or
// exposures typed in another order than the files).
[[nodiscard]] Result<ExposureRatios> MeasureExposureRatios(
    const SampledSignals& signals, std::span<const double> label,
    std::span<const std::string> names, const std::optional<CurvePower>& curve = {});

}  // namespace lightcal
