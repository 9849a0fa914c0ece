// SPDX-License-Identifier: Apache-2.0
// Presets as files: what `export`, `run` and `quick` write.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/presets/preset.h"
#include "lightcal/records/fitted_light.h"
#include "output_files.h"

namespace lightcal::app {

struct PresetOutputs {
  std::vector<OutputFile> files;
  std::vector<std::string> pastes;  // one a target that has one, "unreal: py \"%DIR%/...\""
};

// The files of every target named (none named = every target there is), paths relative to the
// output directory. Warnings that several targets share are given once. Wrong usage: an unknown
// target (names the nearest).
[[nodiscard]] Result<PresetOutputs> PresetFiles(const LightFile& lights, const std::string& stem,
                                                const std::vector<std::string>& targets,
                                                const PresetOptions& options, Warnings& warnings);

// The files go below the directory, the lines name it.
void PlaceUnder(const std::string& directory, PresetOutputs& outputs);

}  // namespace lightcal::app
