// SPDX-License-Identifier: Apache-2.0
// Readings whose place and turn are known against a lamp whose place and aim are, or that say how
// far off its axis they were taken: its exact form there, instead of the law on its axis.
#pragma once

#include <optional>

#include "lightcal/core/units.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/off_axis_pose.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// 1 sigma of an angle off the axis as it was set, and of the axis it is counted from: as stated,
// else a degree.
[[nodiscard]] Radians AngleSigma(const LightDescription& light);

// Over which angles a lamp has to be seen that is called even without being called a bulb.
inline constexpr double kEvenSpan_rad = 45.0 * kRadiansPerDegree;

// The lamp as a source with size and aim. Absent where the session does not say enough: no
// position, no aim (disk, rect, spot), neither aim nor axis (tube), no size, a spot without
// outer_deg; and for kinds that shine evenly from a point.
[[nodiscard]] std::optional<PlacedSource> PlacedSourceOf(const LightDescription& light);

// E/I of a placed row before the source over that of a small one that shines alike all round.
[[nodiscard]] double EmissionBefore(const PlacedSource& source, LightKind kind,
                                    const Observation& row);
// The mean round about its axis, so far off it, up to a constant: of a table, or of a disk, rect or
// spot with outer_deg, which the meter faces.
[[nodiscard]] double LightRoundAbout(const LightDescription& light, double distance_m,
                                     double off_axis_rad);

// Whether the axis that angles count from is sought: not of a cone, whose edge tells too little of
// it.
[[nodiscard]] inline bool AxisIsSought(const LightDescription& light) {
  return light.kind != LightKind::kSpot;
}

// Gives every lit row that is placed its pose before a lamp whose place was found, and how strongly
// it shines there.
void PoseBefore(const PlacedSource& source, LightKind kind, Observations& observations);

// Gives every lit row that is placed, or read by its angle off the axis of a disk, rect or spot
// with outer_deg, its pose before the source and how strongly the source shines there
// (Observation::emission). What is not known of such an angle, AngleSigma and the side of the lamp,
// widens the row (of a photometric lamp's too, whose table_part holds the mean round about). Rows
// the lamp does not reach (behind it, beyond its cone) are rejected with the warning row_rejected;
// where the cone was found from them they are left out silently. Returns how many.
int PlaceOnSource(const LightDescription& light, bool cone_found, Observations& observations);

}  // namespace lightcal::fit
