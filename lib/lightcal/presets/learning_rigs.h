// SPDX-License-Identifier: Apache-2.0
// Rigs to learn a renderer from: a lamp of each kind that nobody measured, with cards on its axis,
// beside it, and facing five ways under a panorama.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/presets/preset.h"

namespace lightcal {

// point, spot, directional, sphere, disk, rect, tube and dome, each in scenes of its own:
// <kind>.rig.<ending>, <kind>.rig_<angle>.<ending>, with its <kind>.rig....preset.json. Their
// lamps are of 2700 K, so that a colour's luminance left out is seen, and of such sizes that no
// two known mistakes come out as one factor.
// Wrong usage: as FindPresetTarget. Refused: as the target's exporter.
[[nodiscard]] Result<std::vector<PresetFile>> LearningRigs(const std::string& target,
                                                           const PresetOptions& options,
                                                           std::string_view generator);

}  // namespace lightcal
