// SPDX-License-Identifier: Apache-2.0
// Preset files read back by what their formats mean, not by what the exporters did.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/presets/check/engine_light.h"

namespace lightcal {

// The text of a file that stands beside the preset, by its plain name.
using FileBeside = std::function<Result<std::string>(const std::string& name)>;

// By the ending of its name (TargetOfFile); a panorama's scene and a layer that sets lights of a
// stage hold none.   Wrong usage: another ending. Refused: bad_preset (not as lightcal writes it,
// or cut off).
[[nodiscard]] Result<std::vector<EngineLight>> LightsIfAny(const std::string& path,
                                                           const std::string& text,
                                                           const FileBeside& beside);
// The same where there must be one. Refused: bad_preset.
[[nodiscard]] Result<std::vector<EngineLight>> LightsOfPreset(const std::string& path,
                                                              const std::string& text,
                                                              const FileBeside& beside);

}  // namespace lightcal
