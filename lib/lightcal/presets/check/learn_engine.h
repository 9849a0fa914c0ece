// SPDX-License-Identifier: Apache-2.0
// What a renderer makes of each kind of light, from its pictures of rigs with lamps of that kind: a
// factor, a law of cones, how it hangs panoramas, whether it applies the camera's exposure.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/presets/check/card_picture.h"
#include "lightcal/presets/check/rig_file.h"
#include "lightcal/presets/learnt_engine.h"
#include "lightcal/presets/preset_table.h"

namespace lightcal {

struct RigPicture {
  std::string name;  // of the picture, in messages
  CheckedRig rig;
  std::array<CardPixels, 2> cards;
  std::optional<PixelUnit> unit;  // absent: nobody knows what a sample stands for
};

struct LearntRenderer {
  LearntEngine engine;
  Warnings warnings;  // kinds_disagree, cone_not_learnt, panorama_not_learnt, picture_left_out
};

// Factor: lux of the cards in the pictures over the meter's; its u95: what the cards differ by, at
// least a code of the picture and .1 %. Pictures of one kind are joined (geometric mean); where
// lamps of two sizes disagree by their areas, the area is what the renderer divides or multiplies
// by. `written`: the law that the rendered file's cones are for (PresetTarget::cone); without it
// pictures off a spot's axis give a cause and no cone. Where more pictures are right as cd/m2 than
// as exposed, the camera's exposure is not applied. Without any unit: factors over the first
// kind's.
// Refused: mixed_kinds (lamps of several kinds light the cards), not_learnt (a measured
// distribution, which is absolute), no_axis_picture (a spot's pictures are all off its axis),
// tone_mapped, encoded_twice, not_srgb_encoded, other colours than the lamp's (whose luminance
// nobody knows), mixed_scales, scale_unknown (one kind alone has no ratio), and as JudgeRender.
[[nodiscard]] Result<LearntRenderer> LearnEngine(std::span<const RigPicture> pictures,
                                                 std::optional<EngineConeLaw> written);

}  // namespace lightcal
