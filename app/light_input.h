// SPDX-License-Identifier: Apache-2.0
// Fitted lights from whatever holds them: a light.json, a preset, a session that was run.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

// path: a light.json, a STEM.preset.json (its lights without readings, effects and tables), a
// session (out/light.json), or a directory that holds a light.json.
// Fails: not_found, unreadable. Refused: bad_light, unknown_key, bad_preset, no_light_file (a
// session that was not run yet).
[[nodiscard]] Result<LightFile> LightsIn(const std::string& path);

}  // namespace lightcal::app
