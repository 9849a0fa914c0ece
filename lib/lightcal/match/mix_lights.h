// SPDX-License-Identifier: Apache-2.0
// Two lamps dimmed so that together they look like a third.
#pragma once

#include <optional>

#include "lightcal/match/match_lights.h"

namespace lightcal::match {

// The mix of smallest difference, as MatchLights decides it, on the line between the two lamps:
//   S = s L / Y_L + (1 - s) W / Y_W,   0 <= s <= 1,
// s the lamp's share of the illuminance. A dimmer is taken to scale a lamp's light and to leave
// its colour (of a lamp that is known at its states this is no more than a start).
struct LightMix {
  Uncertain share;  // of the lamp in the illuminance; the rest is the other's
  // Of what each gave where it was read, 0 to 1: such that both together give the target's
  // illuminance where it is known, else as much as they can. Above 1 the lamp is too weak. Absent
  // where a lamp's spectrum is relative.
  std::optional<Uncertain> dimmer_lamp, dimmer_with;
  Match mixed;  // no gels; stops_lost is 0
};

// request.lamp mixed with another. Gels play no part.
// Refused: "unreachable" (the nearest mix is farther than request.reach in u'v'), and as
// MatchLights.
[[nodiscard]] Result<LightMix> MixLights(const MatchRequest& request, const Spectrum& with,
                                         bool with_measured);

}  // namespace lightcal::match
