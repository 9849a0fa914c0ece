// SPDX-License-Identifier: Apache-2.0
// What lightcal match says of lamps that are set by their own controls.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/calibrate/states/match_states.h"

namespace lightcal::app {

[[nodiscard]] std::string StateMatchTable(const StateMatches& answer);
[[nodiscard]] std::string StateMixText(const StateMatch& mix,
                                       const std::vector<std::string>& names);
// What the intervals are of: whether an instrument's own error is in them; and what the lamp is by
// itself.
[[nodiscard]] std::string DifferenceText(const StateMatch& match, const LightPoint& target,
                                         const std::string& title);
// Why the nearest colour has another CCT than the target, and what has that; "" where none is
// needed.
[[nodiscard]] std::string SameCctText(const StateMatch& nearest,
                                      const std::optional<StateMatch>& same,
                                      const LightPoint& target);

}  // namespace lightcal::app
