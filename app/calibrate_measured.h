// SPDX-License-Identifier: Apache-2.0
// The second half of CalibrateSession, for who changes the readings in between.
#pragma once

#include "session_input.h"

namespace lightcal::app {

// Fits what LoadMeasuredSession gave, with the inputs' hashes. Fails as CalibrateSession.
[[nodiscard]] Result<CalibratedSession> CalibrateMeasured(MeasuredSession measured,
                                                          const CalibrationRequest& request,
                                                          Console& console);

}  // namespace lightcal::app
