// SPDX-License-Identifier: Apache-2.0
// What the times of a lamp's readings tell: a clock that was set, a reading that stands there
// twice, a lamp that was still warming up.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Over the readings of `light` by one instrument, in the order they stand: clock_backwards where
// times go back, duplicate_time where one instrument is said to have been at two distances at once,
// or one reading stands there twice. Once a light each. Readings from pictures are left out.
void CheckTimes(const Session& session, const LightDescription& light, Warnings& warnings);

// The warning `drift`: light that changes with time beyond what the fitted model explains. Over the
// residuals with a time, the trend is what time still explains after intensity, distance offset and
// ambient light (where fitted) took their part of both. It is told when it changes the light by
// more than 2 % from the first reading to the last and by more than one steady lamp of a thousand
// shows (Student's t, at least three degrees of freedom left). Nothing is corrected.
void CheckDrift(const Session& session, const FittedLight& light, Warnings& warnings);

}  // namespace lightcal::fit
