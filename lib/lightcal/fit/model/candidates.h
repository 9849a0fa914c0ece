// SPDX-License-Identifier: Apache-2.0
// A lamp that may be several things, fitted as each of them.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/hypotheses.h"
#include "lightcal/fit/model/prepare.h"
#include "lightcal/fit/model/robust.h"

namespace lightcal::fit {

// The lamp as one hypothesis has it.
struct Candidate {
  LampHypothesis hypothesis;
  Estimation estimation;
  Theta squared{};  // its squared-loss optimum
  double ln_prior = 0.0;
  double ln_probability = 0.0;  // of hypothesis and rows
  RobustEstimate estimate;
  Covariance covariance{};
};

// Every hypothesis of the model solved, the likeliest first; where readings contradict it, the
// likeliest of the robust estimates, a blunder being one reading in fifty. Readings
// that ask for an offset beyond two standard deviations of its prior widen it, with the warning
// prior_conflict, and leave the other hypotheses out. Fails as Solve.
[[nodiscard]] Result<std::vector<Candidate>> SolveCandidates(const Prepared& prepared,
                                                             const ForwardModel& model,
                                                             const Observations& observations,
                                                             const std::string& light,
                                                             Warnings& warnings);

}  // namespace lightcal::fit
