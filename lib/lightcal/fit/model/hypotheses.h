// SPDX-License-Identifier: Apache-2.0
// What a lamp of unknown make may be, and what its readings then say: one estimate for each,
// weighed by how well it explains them.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/prepare.h"
#include "lightcal/light/fixture.h"
#include "lightcal/light/wall_prior.h"

namespace lightcal::fit {

struct LampHypothesis {
  double weight = 1.0;
  std::optional<OffsetPart> offset;      // absent: 15 % of the shortest distance
  double width_m = 0.0, height_m = 0.0;  // of the luminous rectangle it would be; 0 = as stated
  std::optional<WallPrior> walls;        // absent: none shine
};

// Every pair of a fixture's offset and a family of rooms the model names, or a make where no wall
// shines; weights make 1.
[[nodiscard]] std::vector<LampHypothesis> HypothesesOf(const ForwardModel& model);

// The rows and priors as they are if it holds.
[[nodiscard]] Estimation EstimationUnder(const LampHypothesis& hypothesis, const Prepared& prepared,
                                         const Observations& observations);

// The optimum with its scatter settled. Fails as Solve.
[[nodiscard]] Result<Theta> SolveSettled(Estimation& estimation);
// The same from `start`.
[[nodiscard]] Result<Theta> SolveSettledFrom(const Theta& start, Estimation& estimation);

// Logarithm of the probability of the rows, up to a constant that all hypotheses share: Laplace's
// approximation about theta.
[[nodiscard]] double LnEvidence(const Estimation& estimation, const Theta& theta);

}  // namespace lightcal::fit
