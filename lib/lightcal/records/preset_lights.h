// SPDX-License-Identifier: Apache-2.0
// The lights of a lightcal.preset/1, as far as a light file has them.
// Internal to this room.
#pragma once

#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/records/document.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::records {

// Refused: bad_preset, whose subject is `where`.
[[nodiscard]] Result<LightFile> LightsOfPreset(const Node& root, std::string_view where);

}  // namespace lightcal::records
