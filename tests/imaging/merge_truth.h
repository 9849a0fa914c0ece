// SPDX-License-Identifier: Apache-2.0
// A merge from start to end in memory, for tests that ask what comes out.
#pragma once

#include <vector>

#include "lightcal/imaging/bracket/plan_merge.h"
#include "simulated_bracket.h"

namespace lightcal::test {

struct MergedSamples {
  PlannedMerge planned;
  std::vector<float> value, variance;  // row by row, one a sample of the frames
  std::size_t clipped = 0;
};
// Keeps nothing of the frames.
Result<MergedSamples> MergeSamples(const std::vector<Frame>& frames, const MergeRequest& request);

// The request a reader's labels make.
MergeRequest RequestOf(const std::vector<SyntheticExposure>& series);

// Green samples of one patch, in cd/m^2.
struct Patch {
  double nits = 0.0;  // the truth
  double count = 0.0, mean = 0.0, variance = 0.0;
  double claimed = 0.0;  // mean of the variances claimed
  double covered = 0.0;  // share of samples whose interval of one sigma holds the truth
};
// `per_nit` is the signal of the shortest frame for 1 cd/m^2.
std::vector<Patch> PatchesOf(const StepWedge& wedge, const MergedSamples& merged, double per_nit);

}  // namespace lightcal::test
