// SPDX-License-Identifier: Apache-2.0
// The photometric files of a preset, one a light.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/presets/preset.h"
#include "lightcal/presets/preset_light.h"

namespace lightcal {

// Whether the text of that light's file is asked for; of the others the name alone.
using TextAsked = std::function<bool(std::size_t light)>;

// Of every light, or of figures alone of none.
[[nodiscard]] inline TextAsked EveryText(Written written) {
  return [written](std::size_t) { return written != Written::kFigures; };
}
// Of those that an engine is given as a table.
[[nodiscard]] inline TextAsked TextsOfTables(const std::vector<PresetLight>& forms,
                                             Written written) {
  return [&forms, written](std::size_t i) {
    return written != Written::kFigures && forms[i].form == LightForm::kTable;
  };
}

// <stem>-<light>.ies of every light, in order; absent where it has no intensity by direction. The
// names are those ExportIes writes.   Fails: as IntensityTable::Make.
[[nodiscard]] Result<std::vector<std::optional<PresetFile>>> IesFiles(const LightFile& lights,
                                                                      const std::string& stem,
                                                                      const TextAsked& asked);

}  // namespace lightcal
