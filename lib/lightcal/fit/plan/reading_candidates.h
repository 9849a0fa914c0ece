// SPDX-License-Identifier: Apache-2.0
// The readings of one light that a person could take next. Internal to plan_readings.cc.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/fit/plan/plan_readings.h"

namespace lightcal::fit {

// Of the session's first (only) light, as plan_readings.h says; `fitted` is what is known of it.
// None stands farther than `reach_m`, unless one already does.
[[nodiscard]] std::vector<PlannedReading> ReadingCandidates(const Session& session,
                                                            const FittedLight* fitted,
                                                            double reach_m);
// Farthest over nearest distance of its readings with the lamp on.
[[nodiscard]] std::optional<double> DistanceSpan(const Session& session);

}  // namespace lightcal::fit
