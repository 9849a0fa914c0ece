// SPDX-License-Identifier: Apache-2.0
// How unevenly a lamp without a measured distribution shines to its sides, and how well a table
// of directions tells it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/vec3.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// 1 sigma, along each axis, of the gradient by which ln I differs from direction to direction.
// Absent: its kind says how it shines, or nothing is known of its fixture.
[[nodiscard]] std::optional<Vec3> GradientOf(const LightDescription& light);

// Of a point. One whose fixture nobody states may shine to the side alone from which it was read;
// as bulbs do where it was read from several (TakenToShineEvenly). Meters of which a distance alone
// is known stood on its axis; where nobody states its aim they stood anywhere, and the middle is no
// direction.
[[nodiscard]] std::optional<UnevenLight> UnevenOf(const Observations& observations,
                                                  const LightDescription& light);

// Whether its meters stood on several sides of a point whose fixture nobody states: it counts as
// even, which SayThatItShinesEvenly says.
[[nodiscard]] bool TakenToShineEvenly(const Observations& observations,
                                      const LightDescription& light);
[[nodiscard]] std::string SayThatItShinesEvenly(const std::string& light);

// 1 sigma of ln I so far off the axis beside that on it, of a point; one whose fixture nobody
// states is as uneven as bulbs are: |sd (u - axis)| = 2 sin(angle/2) rms(sd), which way round the
// axis nobody says. 0 of all other kinds.
[[nodiscard]] double UnevenAside(const LightDescription& light, Radians off_axis);

// Of such a point, beside the observations: 1 sigma of ln I towards the meter beside the mean
// towards all, times the root of how many readings lie in that direction, which share it. A meter
// whose place is not known may be anywhere. Of meters that say how far off its axis they stood,
// beside the axis, which is what is sought (UnevenAside): lobes are broad, and all of them share
// one. Empty where all lie in one direction.
[[nodiscard]] std::vector<double> UnevenTowards(const Observations& observations,
                                                const LightDescription& light);

// Of a lamp with a table, beside the observations: 1 sigma of ln I between its nodes
// (Observation::table_error), times the root of how many readings share it: nodes miss neighbouring
// directions alike. 0 at a node.
[[nodiscard]] std::vector<double> UnevenByTable(const Observations& observations);

}  // namespace lightcal::fit
