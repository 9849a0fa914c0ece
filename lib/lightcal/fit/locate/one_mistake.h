// SPDX-License-Identifier: Apache-2.0
// One reading of a lamp whose place is sought that contradicts the others: which it is, as far as
// they tell. Internal to locate.cc.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/locate/locate.h"
#include "lightcal/fit/locate/locate_search.h"
#include "lightcal/light/wall_prior.h"

namespace lightcal::fit {

// The readings that are held to be right.
struct Kept {
  PlacedProblem problem;
  std::vector<PlacedSolution> solutions;
  std::vector<LeftOut> rejected;
};

[[nodiscard]] Kept WithoutThese(Kept kept, const std::vector<LeftOut>& left_out);

[[nodiscard]] int DegreesOfFreedom(const PlacedEstimation& estimation);

// Where the readings contradict one another in the dark, or beside the walls that they may see,
// that none is wrong is weighed against each being mistyped: by the evidence of the others and, of
// the ways in which people mistype (mistyped.h), of all with it corrected. Sigmas may be
// understated up to four times, and other light may shine. One that is a hundred times as likely as
// all else is left out (true) where two degrees of freedom say so; false where noise has four
// fifths of it. Refused: model_misfit, which names one that is twenty times as likely as all else,
// else the two or three that are, else none.
[[nodiscard]] Result<bool> LeaveMistakeOut(Kept& kept, const Observations& observations,
                                           const std::vector<WallHypothesis>& walls,
                                           const std::string& light);

}  // namespace lightcal::fit
