// SPDX-License-Identifier: Apache-2.0
// A bulb that was read beside its axis too: uneven, or a beam after all.
#pragma once

#include <optional>

#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Of a point that some readings say they saw at an angle off its axis, and that is said to be a
// bulb or nobody says what it is: the bulb, where each of them lies within what bulbs are uneven
// (UnevenAside) and its own sigma; three standard deviations of a bulb, 2.5 of another, which has
// to be seen over 45 degrees. Its flux holds what was seen aside: the mean of all directions may be
// below a bulb's usual part of the axis where the dimmest was, and above it where the brightest
// was; of another than a bulb anything from darkness to an even lamp beyond the widest angle.
// Absent: it was not read so, or no such bulb gives these readings. `out`, `session_out`: as
// FitByDistance; nothing is said where it is absent.
[[nodiscard]] std::optional<FittedLight> FitUnevenBulb(
    const Session& session, const LightDescription& light, const Observations& observations,
    const FitSettings& settings, const FittedLight& out, FittedSession& session_out);

}  // namespace lightcal::fit
