// SPDX-License-Identifier: Apache-2.0
// What the test and the bench of `tradeoff` judge its recommendations by, written without the
// study's own code.
#pragma once

#include <algorithm>
#include <cmath>

#include "lightcal/records/accuracy_profile.h"
#include "lightcal/tradeoff/outcome.h"
#include "lightcal/tradeoff/timing.h"

namespace lightcal::test {

// As often as a recommendation needs, not as often as a table for people deserves.
inline constexpr tradeoff::TimingRules kFewRuns{.least_runs = 7, .most_runs = 9, .seconds = 0.2};

// What the strictest profile is.
inline AccuracyProfile StrictestByHand(double tolerance) {
  AccuracyProfile profile;
  profile.tolerance_relative = tolerance;
  profile.effects = "all";
  profile.estimator.solver = SolverChoice::kFull;
  profile.estimator.bounce_patches = 48;
  profile.estimator.interval_samples = 100000;
  return profile;
}

// Whether every figure lies within the tolerance and a third of its own u, and u within a third of
// what it should be.
inline bool Holds(const tradeoff::LightFigures& truth, const tradeoff::LightFigures& got,
                  double tolerance) {
  const auto within = [tolerance](double off, double sd) {
    return std::abs(off) <= std::max(1e-9, std::min(tolerance, sd / 3.0)) + 1e-12;
  };
  if (!within(got.ln_strength - truth.ln_strength, truth.sd_ln)) return false;
  if (std::abs(got.sd_ln - truth.sd_ln) > truth.sd_ln / 3.0 + 1e-9) return false;
  if (truth.mired && (!got.mired || !within((*got.mired - *truth.mired) / 100.0,
                                            truth.sd_mired.value_or(0.0) / 100.0))) {
    return false;
  }
  return !truth.duv ||
         (got.duv && within((*got.duv - *truth.duv) / 0.1, truth.sd_duv.value_or(0.0) / 0.1));
}

}  // namespace lightcal::test
