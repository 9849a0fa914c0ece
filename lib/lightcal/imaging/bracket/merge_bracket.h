// SPDX-License-Identifier: Apache-2.0
// A bracket of frames -> one linear picture with a variance for every sample.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/view2d.h"
#include "lightcal/imaging/bracket/noise.h"
#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/records/accuracy_profile.h"
#include "lightcal/records/frame.h"

namespace lightcal {

struct EncodedErrors;  // encoded_errors.h

struct MergePlan {
  // Of each frame, ascending, in any unit: signal = exposure X.
  std::vector<double> exposure;
  // Of each frame: Var(signal) = scale signal + offset, at least one of them above 0.
  std::vector<NoiseProfile> noise;
  double usable = 0.9;  // share of the clip up to which a sensor is believed
  double floor = 0.0;   // signal below which codes say nothing (encoded frames clip at black)
  double fixed_pattern = kMiddlingFixedPattern;  // p: pixels differ in sensitivity by p (1 sigma)
  double part_sd = 0.0;  // of a part of the picture, beside the rest: ExposureRatios
  MergeEstimator estimator = MergeEstimator::kLikelihood;
  std::shared_ptr<const EncodedErrors> encoded{};  // of frames whose codes came through a curve
};

// Maximum likelihood for every sample, with t exposure, y signal:
//   X = sum w y/t / sum w,   w = t^2 / (scale X t + offset),   Var X = 1 / sum w + (p X)^2
// X first from the frames' sums (exact for shot noise), then once more with these weights. A frame
// counts where the predicted signal t X, not its own noisy sample, is below usable * clip, and its
// sample below the clip. Negative signals stay. Where frames contradict each other (chi-square five
// standard deviations above its mean n, the degrees of freedom) Var is widened by chi-square / n;
// farther than chance, from n + 25 on, each frame errs by tau besides its noise:
//   Var X = 1/W + tau^2 S/W,   tau^2 = (chi-square - n)/(W - S),   W = sum w, S = sum w^2 / W
// Clipped in every frame: X is the shortest frame's, a lower bound, and its standard deviation is
// X. The other estimators differ in w, of the frames that count, and look for no contradictions. Of
// codes, 1/sum w is taken times the place's factor (encoded_errors.h):
//   sums     w = t / scale: sum y / sum t of frames at one ISO
//   longest  all weight on the longest frame that counts
//   Var X = sum (w/t)^2 (scale X t + offset) / (sum w)^2 + (p X)^2
class BracketMerger {
 public:
  // `frames` in the order of plan.exposure; they and their samples outlive the merger.
  // Refused: bad_plan (not as above), mixed_size.
  static Result<BracketMerger> Make(std::span<const SignalFrame> frames, const MergePlan& plan);

  // Rows [first, first + count): row i of the views is row first + i. Any number of threads.
  // Returns how many samples are clipped in every frame.
  std::size_t MergeRows(int first, int count, View2d<float> value, View2d<float> variance) const;

  // chi-square of the frames about X, up to where they contradict each other, and its degrees of
  // freedom (0 or less where one frame counts), of each sample of row y.
  void ScatterOfRow(int y, std::span<float> chi2, std::span<float> degrees) const;

  [[nodiscard]] const MergePlan& plan() const { return plan_; }
  [[nodiscard]] std::span<const SignalFrame> frames() const { return frames_; }

 private:
  BracketMerger() = default;
  std::span<const SignalFrame> frames_;
  MergePlan plan_;
};

// How much pixels differ in sensitivity (photo response non-uniformity), from the flattest places
// of the merged picture: what neighbours of a colour scatter beyond their variance, as a share of
// the signal, in the lower quartile of tiles; at most twice what the plan has (1 %), which it stays
// where fewer than 16 tiles are well exposed. A textured picture without flat places reads too
// high, never too low. Of codes the flattest twentieth is asked: compression leaves little of it,
// and kHiddenDetail has what other places show.
[[nodiscard]] double EstimateFixedPattern(const BracketMerger& merger,
                                          const FrameDone& done_with = {});

}  // namespace lightcal
