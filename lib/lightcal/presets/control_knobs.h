// SPDX-License-Identifier: Apache-2.0
// A lamp's controls as tables that an engine's script can turn.
#pragma once

#include "lightcal/presets/preset_light.h"
#include "lightcal/records/document.h"

namespace lightcal {

// [{"control", "reference", "table": [[label, energy, r, g, b]...]}] of the lamp's sweeps, nothing
// where it has none. With k the light over that at the reference and Y the luminance of a
// max-normalised colour, along each control
//   energy = k Y_ref/Y,   r = R/R_ref ...      (1 where R_ref is 0),
// 1 at the reference itself: what the engine's own number and colour are to be multiplied by. Two
// controls are taken to act independently, which they do along either of them.
[[nodiscard]] records::Node KnobsNode(const PresetOptions& options, const FittedLight& lamp,
                                      const PresetLight& light);

}  // namespace lightcal
