// SPDX-License-Identifier: Apache-2.0
// A renderer's factor for a kind of light, from its picture of a rig with lamps of that kind.
#pragma once

#include <array>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/presets/check/card_picture.h"
#include "lightcal/presets/check/rig_file.h"
#include "lightcal/presets/learnt_engine.h"
#include "lightcal/presets/preset_table.h"

namespace lightcal {

// Factor: lux of the cards in the picture over the meter's. u95_relative: what the two cards
// differ by, at least a code of the picture and .1 %.
// Refused: mixed_kinds (lamps of several kinds light the cards), not_learnt (a measured
// distribution, which is absolute), tone_mapped, encoded_twice, not_srgb_encoded, other colours
// than the lamp's (whose luminance nobody knows), and as JudgeRender.
[[nodiscard]] Result<LearntKind> LearnKind(const CheckedRig& rig,
                                           const std::array<CardPixels, 2>& cards, PixelUnit unit,
                                           const std::string& picture);

}  // namespace lightcal
