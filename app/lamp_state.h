// SPDX-License-Identifier: Apache-2.0
// Lights of a file at the states of their controls that a person asks for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/states/state_answer.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

// state_combined, where the answer was put together from states that differ from it in several
// controls.
[[nodiscard]] std::optional<Warning> CombinedWarning(const FittedLight& light,
                                                     const StateAnswer& answer);

// state_geometry, where another zoom or modifier lends it the offset and the beam.
[[nodiscard]] std::optional<Warning> SharedGeometryWarning(const FittedLight& light,
                                                           const FixtureState& at);

// Each text: "dimmer=18,cct_K=4500", of every light that has states, or of one, "key:dimmer=18".
// The lights become what they are there; others stay. Warns of states that were put together from
// others.  Wrong usage: no state, a light that there is not. Refused: no_states, and as
// AnswerState.
[[nodiscard]] Result<Warnings> SetStates(const std::vector<std::string>& texts, LightFile& file);

}  // namespace lightcal::app
