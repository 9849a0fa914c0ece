// SPDX-License-Identifier: Apache-2.0
// What every engine makes of a lamp where a meter stood.
#pragma once

#include <memory>
#include <vector>

#include "lightcal/presets/environment_picture.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/records/engine_answers.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// What an engine's exporter makes of every light of a file.
struct EngineExport {
  const PresetTarget* engine = nullptr;
  std::vector<DerivedLight> derived;   // one a light
  std::vector<EngineLight> read_back;  // by the file's own meaning; empty beside an emission law
};

// See EngineAnswers.
[[nodiscard]] std::vector<ParityRow> ParityOf(
    const LightFile& lights, const std::vector<EngineExport>& exports,
    const std::vector<std::shared_ptr<const EnvironmentPicture>>& environments = {});

}  // namespace lightcal
