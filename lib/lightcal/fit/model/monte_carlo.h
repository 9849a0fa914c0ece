// SPDX-License-Identifier: Apache-2.0
// Propagation of distributions by sampling, for where the linear covariance is too simple.
#pragma once

#include <array>
#include <cstdint>

#include "lightcal/core/progress.h"
#include "lightcal/core/result.h"
#include "lightcal/fit/model/uncertainty.h"

namespace lightcal::fit {

struct SampledParameter {
  double mean = 0.0;
  double sd = 0.0;
  double low = 0.0, high = 0.0;  // probabilistically symmetric 95 % interval
};

struct SampledEstimate {
  std::array<SampledParameter, kParameters> parameters;
  std::int64_t samples = 0;
  bool stable = false;  // every figure to the digits asked for
};

struct SamplingRule {
  int digits = 2;           // significant digits of each standard deviation that must stand
  int largest_blocks = 30;  // 1: one block and no question of digits
  int block = 10000;        // samples of each
  bool all_blocks = false;  // draw them all, stable or not
  Progress progress{};      // of the draws, by how many are likely to do
};

// At least `samples` draws, in as few blocks of at most 10 000 as hold them. samples >= 2.
[[nodiscard]] SamplingRule JustSamples(int samples);

// Draws what was measured from its distribution (each reading's own error, of readings that the
// model takes alike that of their mean, each instrument's calibration, the considered influences
// and the priors, normal in the rows' own forms), finds the optimum of each draw by Newton's steps
// from the linear prediction, in blocks until twice the standard deviation of the mean over blocks
// of mean, sd, low and high stays below half the last digit asked for, for every free parameter
// (adaptive procedure of JCGM 101:2008, 7.9). Seeded by the rows themselves. Refused:
// underdetermined. Fails: no_convergence (more than one draw in a hundred has no optimum).
[[nodiscard]] Result<SampledEstimate> SampleEstimate(const UncertaintyInput& input,
                                                     const SamplingRule& rule = {});

}  // namespace lightcal::fit
