// SPDX-License-Identifier: Apache-2.0
// How sure a setting is: of its light, and of the labels that give it.
#pragma once

#include "lightcal/calibrate/states/match_states.h"
#include "lightcal/calibrate/states/settable_lamp.h"

namespace lightcal {

// The settings' light beside the target, with 95 % intervals by draws of both colours and levels.
[[nodiscard]] StateMatch DescribedMatch(Settings settings, const StateMatchRequest& request);

// (J^T J)^-1 of the outcomes over their sigmas: where the labels may stand that give this light.
void SetLabelIntervals(const Lamps& lamps, const LightPoint& target, StateMatch& match);

}  // namespace lightcal
