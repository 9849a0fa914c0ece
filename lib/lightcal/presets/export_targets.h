// SPDX-License-Identifier: Apache-2.0
// Lights as the files of several engines at once, where all that `options` are to hold is known. Of
// lights as they were fitted or read ask ExportPresets (calibrate/export_presets.h), which adds what
// their controls do.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/presets/preset.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

struct ExportedPresets {
  std::vector<PresetFile> files;    // each name once
  std::vector<std::string> pastes;  // one a target that has one, "unreal: py \"%DIR%/...\""
  Warnings warnings;                // each once, whoever said it
};

// The files of every target named (none named = every target there is), in that order; `stem`
// begins their names. With options.rig each target that has one brings its rig too, as a second
// file. Of targets that nobody named, warnings of what their format cannot hold are
// left out. With options.into: the lamps it names onto lights that are there, every target named
// (none named = every one that can).   Wrong usage: an unknown target (names the nearest).
// Refused: into_unsupported, and as CheckInto; else refuses and fails as Exporter.
[[nodiscard]] Result<ExportedPresets> ExportTargets(const LightFile& lights,
                                                    const std::vector<std::string>& targets,
                                                    const std::string& stem,
                                                    const PresetOptions& options);

}  // namespace lightcal
