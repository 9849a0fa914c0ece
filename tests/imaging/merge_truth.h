// SPDX-License-Identifier: Apache-2.0
// A merge from start to end in memory, for tests that ask what comes out.
#pragma once

#include <vector>

#include "lightcal/imaging/plan_merge.h"
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

}  // namespace lightcal::test
