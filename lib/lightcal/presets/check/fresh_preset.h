// SPDX-License-Identifier: Apache-2.0
// What an engine's file holds of lights when it is written anew: whether a file that strays from
// the readings was edited, or the engine lacks what the lamp is.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/presets/check/engine_light.h"
#include "lightcal/presets/preset.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

struct FreshPreset {
  std::vector<EngineLight> lights;  // as its reader takes them
  Warnings substituted;             // one a lamp that it holds as something else
};

// Absent: nobody reads that engine's file, or it takes none of these lights.
[[nodiscard]] std::optional<FreshPreset> FreshPresetOf(const PresetTarget& target,
                                                       const LightFile& lights,
                                                       SpotForm spots = SpotForm::kAuto);

}  // namespace lightcal
