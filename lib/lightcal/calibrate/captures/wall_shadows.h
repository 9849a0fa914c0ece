// SPDX-License-Identifier: Apache-2.0
// The light on a wall that is not the lamp's own, seen where a card keeps the lamp's off.
#pragma once

#include <vector>

#include "lightcal/calibrate/captures/wall_pictures.h"
#include "lightcal/core/result.h"
#include "lightcal/imaging/scene/wall_samples.h"
#include "lightcal/records/capture.h"

namespace lightcal {

// What the picture shows in the shadows that a card throws. Refused: bad_region (off the picture or
// the wall, or hardly darker than the wall beside it, `lit`).
[[nodiscard]] Result<std::vector<SeenPlace>> SeenInShadows(const CaptureDescription& capture,
                                                           const WallPicture& picture,
                                                           const WallModel& model,
                                                           const std::vector<SeenPlace>& lit);

}  // namespace lightcal
