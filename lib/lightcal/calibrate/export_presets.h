// SPDX-License-Identifier: Apache-2.0
// Lights as the files of several engines at once: names and texts, nothing is written.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/presets/export_targets.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// As ExportTargets, with what the lights' controls do (options.sweeps, or ControlSweepsOf where it
// has none); refuses and fails as that. The pictures of domes are the caller's:
// options.environments, by LoadEnvironments.
[[nodiscard]] Result<ExportedPresets> ExportPresets(const LightFile& lights,
                                                    const std::vector<std::string>& targets = {},
                                                    const std::string& stem = "lights",
                                                    PresetOptions options = {});

}  // namespace lightcal
