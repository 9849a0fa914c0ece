// SPDX-License-Identifier: Apache-2.0
// Layouts that do not tell a lamp's place, said with the reading that would. Internal to locate.cc.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/locate/locate_search.h"

namespace lightcal::fit {

inline constexpr int kFewestPlacedReadings = 4;    // ln I and three coordinates
inline constexpr double kAllowedChiSquared = 9.0;  // beyond the best: what the readings allow

// Whether all lit readings are of one normal, in one plane, on one circle or line exactly.
[[nodiscard]] bool NearlyOnOneCircle(const PlacedProblem& problem);
[[nodiscard]] bool OnOneCircleExactly(const PlacedProblem& problem);

// position_unknown (fewer than four readings), cocircular or underdetermined.
[[nodiscard]] tl::unexpected<Error> RefuseLayout(const PlacedProblem& problem,
                                                 const std::vector<PlacedSolution>& solutions,
                                                 const std::string& light);
// mirror_ambiguous: two places or more explain the readings.
[[nodiscard]] tl::unexpected<Error> RefuseMirror(const PlacedProblem& problem,
                                                 const std::vector<PlacedSolution>& apart,
                                                 const std::string& light);

}  // namespace lightcal::fit
