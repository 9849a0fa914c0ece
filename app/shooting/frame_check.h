// SPDX-License-Identifier: Apache-2.0
// What a frame's own tags say, against what the camera was asked for.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/tethered_shoot.h"

namespace lightcal::app {

// Reads the tags of the file at `path` into `frame`.  Warns: exposure_conflict (time off by more
// than half a third of a stop and its label's rounding, f-number by 6 %, ISO by 12 %),
// no_exposure_time.  Fails and refuses as ReadFrameInfo.
[[nodiscard]] Result<Warnings> CheckFrame(const std::string& path, const TetheredShoot& shoot,
                                          ShotFrame& frame);

}  // namespace lightcal::app
