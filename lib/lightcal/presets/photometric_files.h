// SPDX-License-Identifier: Apache-2.0
// The photometric files of a preset, one a light.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/presets/preset.h"

namespace lightcal {

// <stem>-<light>.ies of every light, in order; absent where it has no intensity by direction. The
// names are those ExportIes writes.   Fails: as IntensityTable::Make.
[[nodiscard]] Result<std::vector<std::optional<PresetFile>>> IesFiles(const LightFile& lights,
                                                                      const std::string& stem);

}  // namespace lightcal
