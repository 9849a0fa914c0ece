// SPDX-License-Identifier: Apache-2.0
// Lights of a file at the states of their controls that a person asks for.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "console.h"
#include "lightcal/core/result.h"
#include "lightcal/fit/states/state_answer.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

// "measured", "between", "combined".
[[nodiscard]] std::string_view BasisWord(StateBasis basis);
// Controls by name: numbers and words.
[[nodiscard]] Node StateNode(const FixtureState& state);

// state_combined, where what is known of that state of a lamp was put together from states that
// differ from it in several controls.
[[nodiscard]] std::optional<Warning> CombinedWarning(const std::string& lamp,
                                                     const FixtureState& state, StateBasis basis);

// state_geometry, where another zoom or modifier lends it the offset and the beam.
[[nodiscard]] std::optional<Warning> SharedGeometryWarning(const FittedLight& light,
                                                           const FixtureState& at);

// Each text: "dimmer=18,cct_K=4500", of every light that has states, or of one, "key:dimmer=18".
// The lights become what they are there; others stay. Warns of states that were put together from
// others.  Wrong usage: no state, a light that there is not. Refused: no_states, and as
// AnswerState.
[[nodiscard]] Result<Warnings> SetStates(const std::vector<std::string>& texts, LightFile& file);

}  // namespace lightcal::app
