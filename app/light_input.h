// SPDX-License-Identifier: Apache-2.0
// Fitted lights from whatever holds them: a light.json, a preset, a session that was run.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

// The file that LightsIn reads: what its lights name (a dome's picture) lies beside it. Refused: as
// there.
[[nodiscard]] Result<std::string> LightFileAt(const std::string& path);

// path: a light.json, a STEM.preset.json (its lights without readings, effects and tables), a
// session (out/light.json), or a directory that holds a light.json.
// Fails: not_found, unreadable. Refused: bad_light, unknown_key, bad_preset, no_light_file (a
// session that was not run yet).
[[nodiscard]] Result<LightFile> LightsIn(const std::string& path);

}  // namespace lightcal::app
