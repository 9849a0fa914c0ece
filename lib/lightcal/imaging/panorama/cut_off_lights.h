// SPDX-License-Identifier: Apache-2.0
// Lights of a dome that end where its picture does: clipped there, or drawn flat.
#pragma once

#include <optional>

#include "lightcal/core/result.h"
#include "lightcal/imaging/panorama/measure_dome.h"

namespace lightcal {

// `clipped_always`: that something is clipped is known, be it a pixel or two.
[[nodiscard]] std::vector<DomeLight> FindLights(const DomeInput& input, bool clipped_always);

// A plateau at the picture's largest value is either clipped or drawn, where nobody says from which
// value samples are clipped. Clipped it is if a reading tells: in cd/m^2 one that exceeds what the
// picture holds; a card that took away more than any light of the picture gives. Else it is warned
// (maybe_clipped). `reading` in the picture's own frame.
// Refused: several_clipped (a card, and two or more lights that lit the meter end at that value),
// shaded_light_unknown (a card that took away more than the one light shows that ends there, or
// hardly anything, and another light could have been it).
[[nodiscard]] Result<void> JudgePlateaus(const DomeRequest& request,
                                         const std::optional<DomeReading>& reading,
                                         MeasuredDome& measured);

}  // namespace lightcal
