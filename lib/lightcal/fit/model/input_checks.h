// SPDX-License-Identifier: Apache-2.0
// What no estimate can repair: mixed units, light that grows with distance, places outside the
// room, sizes that are missing or no lamp's.
#pragma once

#include <optional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Refused: units_ambiguous when ln(E d^2/cos(tilt)) of the rows falls into two groups apart by the
// square of a ratio of length units (cm/m: 10 000, ft/m: 10.76) or by a ratio of illuminance units
// (fc/lx: 10.76, klx/lx: 1000). Rows at a grazing tilt, beyond 72.5 degrees, are not compared: what
// they read is the walls' light. The message names the smaller group.
[[nodiscard]] Result<void> CheckUnits(const Observations& observations, const std::string& light);

// Refused: increasing_with_distance when the slope of ln E over ln d is above zero by two of its
// own standard deviations, whether what turned meters read is the lamp's or its walls'. Adds the
// warning slow_falloff while it stays above -0.5: more than half of what was read is not the lamp's
// direct light.
[[nodiscard]] Result<void> CheckFalloff(const Observations& observations,
                                        const LightDescription& described, Warnings& warnings);

// Warns of a lamp or a reading outside the [room] (outside_room): for its walls' light it counts as
// just inside.
void CheckRoom(const Session& session, const LightDescription& light, Warnings& warnings);

// Refused: size_missing (a rect, disk or tube without its sides: near it the law is another).
// Warns of lengths that no lamp, room or meter has (units_suspect): 120 x 60 for centimetres.
[[nodiscard]] Result<void> CheckLengths(const Session& session, const LightDescription& light,
                                        Warnings& warnings);

// The same of one distance, for whoever is about to write it down; absent where it may be so.
[[nodiscard]] std::optional<Warning> DoubtOfDistance(Surroundings surroundings,
                                                     const std::string& light, Metres distance);

}  // namespace lightcal::fit
