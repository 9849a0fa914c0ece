// SPDX-License-Identifier: Apache-2.0
// What is known of a lamp whose place was sought, kept for predictions. Internal to locate.cc and
// fit_located_light.cc.
#pragma once

#include <vector>

#include "lightcal/fit/locate/placed_modes.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::fit {

// The modes of its place and their mean, from the frame's units to cd, m, lx.
[[nodiscard]] LocatedLamp LocatedLampOf(const PlacedFrame& frame,
                                        const std::vector<PlacedMode>& modes,
                                        const MixedPlace& mixed);

// A relative error (1 sigma) that all readings share.
void AddCalibration(double calibration, LocatedLamp& lamp);

}  // namespace lightcal::fit
