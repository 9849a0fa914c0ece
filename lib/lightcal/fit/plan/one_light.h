// SPDX-License-Identifier: Apache-2.0
// The part of a session that a plan of one light's readings is made from, and the meter that would
// take the next.
// Internal to this room.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// The session as if it had that light alone, and no colour. Refused: unknown_light.
[[nodiscard]] Result<Session> AloneIn(const Session& session, const std::string& light);

// A reading by the meter that read the session's one light last.
[[nodiscard]] Reading LikeTheLast(const Session& session);

// Lux: of a meter that shows steps of so much, 0 unknown; a tenth of a lux, as of most that people
// own, or less where its readings show it.
[[nodiscard]] double LastDigit(double display_step_lx);

// Lux: the display's step where it counts in a reading, so that planned ones keep it; else 0.
[[nodiscard]] double CoarseStep(const Session& session, double step);

}  // namespace lightcal::fit
