// SPDX-License-Identifier: Apache-2.0
// What a meter will show where nobody has read yet. Internal to plan_readings.cc.
#pragma once

#include <array>
#include <optional>

#include "lightcal/core/units.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/reading_plan.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Of the session's first (only) light as `now` has it, of one of 1000 cd where nothing is known
// (null); behind a card what the fit did not give to the lamp. Below 0: the lamp's place is needed
// for it and not known.
[[nodiscard]] Lux ExpectedIlluminance(const Session& session, const FittedLight* now,
                                      const PlannedReading& planned);

// Three that are equally probable (its quantiles at 1/6, 1/2 and 5/6), of a reading by the meter of
// `like`; absent where `now` is one normal, for readings off the axis and by places.
[[nodiscard]] std::optional<std::array<Lux, 3>> LikelyIlluminances(const Session& session,
                                                                   const FittedLight* now,
                                                                   const PlannedReading& planned,
                                                                   const Reading& like);

}  // namespace lightcal::fit
