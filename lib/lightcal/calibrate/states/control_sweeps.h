// SPDX-License-Identifier: Apache-2.0
// A lamp with controls as figures and sheets show it: along each control, the others as at its
// reference state.
#pragma once

#include <vector>

#include "lightcal/records/control_sweep.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// One of every control that is a number and stood at two or more with the others alike. The curve
// by AnswerState at 41 places, closer together where states are; of a lamp whose states say nothing
// between them (several controls that add light) what was read alone.
[[nodiscard]] std::vector<ControlSweep> ControlSweepsOf(const FittedLight& light);
// Those of all its lights, in their order.
[[nodiscard]] std::vector<ControlSweep> ControlSweepsOf(const LightFile& file);

}  // namespace lightcal
