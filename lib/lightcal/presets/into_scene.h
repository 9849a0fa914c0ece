// SPDX-License-Identifier: Apache-2.0
// Lamps whose figures go onto lights that stand in a person's scene: which lamp onto which.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/presets/preset.h"
#include "lightcal/records/document.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// The one lamp of the file onto every light of that pattern.   Refused: into_many_lamps (a pattern
// cannot say which of several lamps a light gets).
[[nodiscard]] Result<std::vector<IntoRow>> IntoByPattern(const LightFile& lights,
                                                         const std::string& pattern);

// Refused: into_map (a row without a lamp or an object), into_unknown_lamp (names the nearest),
// into_two_lamps (one object, two lamps), into_no_light (a dome: no light of a scene is one).
[[nodiscard]] Result<void> CheckInto(const LightFile& lights, std::span<const IntoRow> rows);

// The lamps that the rows name, with their pictures.
struct IntoLights {
  LightFile lights;
  PresetOptions options;
};
[[nodiscard]] IntoLights OnlyInto(const LightFile& lights, const PresetOptions& options);

// [{"lamp", "object"}], absent without rows.
[[nodiscard]] records::Node IntoNode(std::span<const IntoRow> rows);

}  // namespace lightcal
