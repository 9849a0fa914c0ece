// SPDX-License-Identifier: Apache-2.0
// Whether readings tell a beam: where they are too few or too far aside, what to read.
// Internal to this room.
#pragma once

#include <optional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/fit/beam/beam_profile.h"
#include "lightcal/fit/beam/beam_rows.h"

namespace lightcal::fit {

// Refused: beam_unknown (nothing read near the axis; the edge not seen; the beam angle's interval
// too wide), with the angle to read at.
[[nodiscard]] Result<void> CheckKnownBeam(const BeamRows& rows, const BeamProfile& profile,
                                          const std::string& light);

// The refusal of readings that are all far from the axis, of a beam so wide where that is known.
[[nodiscard]] tl::unexpected<Error> NothingNearAxis(double nearest_rad,
                                                    std::optional<double> wide_deg,
                                                    const std::string& light);

}  // namespace lightcal::fit
