// SPDX-License-Identifier: Apache-2.0
// How far off each distance is by itself; what all are off by is the distance offset.
#pragma once

#include <optional>

#include "lightcal/core/units.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// The inch or the centimetre, where a session's distances are whole ones as one reads them off a
// tape: three different ones or more that are not all whole fives (of inches: or half feet), at
// which one sets a meter up rather than reads where it stands.
[[nodiscard]] std::optional<Metres> DistanceStepOf(const Session& session);

// 1 sigma of a reading's distance: what it states, else what its light does, else that of a
// tape held by hand (effects/distance_error.h) and step/sqrt(12). Absent of what a manufacturer
// prints and of positions.                                                                      [m]
[[nodiscard]] std::optional<double> DistanceSigmaOf(const LightDescription& light,
                                                    const Reading& reading,
                                                    const std::optional<Metres>& step);

// Whether whole inches alone, of no stated sigma, make the light's distances less sure.
[[nodiscard]] bool RoundedToInches(const Session& session, const LightDescription& light);

// Adds to the sigma of each row with the lamp what its distance's does to it:
//   s(ln E) = 2 s_d / r, r = d and the mean offset of the lamp's fixture.
// n rows at one distance and angle stand at one place and share it: each takes sqrt(n) times that.
// The walls' light, which hardly follows the distance, is counted as the lamp's: at a distance
// where it is most of the light s_d/d is small.
void WidenByDistances(const LightDescription& light, Observations& observations);

}  // namespace lightcal::fit
