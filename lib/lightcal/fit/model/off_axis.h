// SPDX-License-Identifier: Apache-2.0
// Readings whose place and turn are known against a lamp whose place and aim are: its exact form
// there, instead of the law on its axis.
#pragma once

#include <optional>

#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/off_axis_pose.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// The lamp as a source with size and aim. Absent where the session does not say enough: no
// position, no aim (disk, rect, spot), neither aim nor axis (tube), no size, a spot without
// outer_deg; and for kinds that shine evenly from a point.
[[nodiscard]] std::optional<PlacedSource> PlacedSourceOf(const LightDescription& light);

// Gives every placed lit row its pose before the source and how strongly the source shines there
// (Observation::emission). Rows the lamp does not reach (behind it, beyond its cone) are rejected
// with the warning row_rejected; where the cone was found from them they are left out silently.
// Returns how many.
int PlaceOnSource(const LightDescription& light, bool cone_found, Observations& observations);

}  // namespace lightcal::fit
