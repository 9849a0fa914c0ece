// SPDX-License-Identifier: Apache-2.0
// Why a rendered card is not as bright as the meter says: known mistakes and what each does.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/presets/check/card_picture.h"
#include "lightcal/presets/check/rendered_color.h"
#include "lightcal/presets/check/rig_file.h"
#include "lightcal/presets/preset_table.h"

namespace lightcal {

struct RenderCause {
  std::string code;     // "none", "missing_luminance_division", "falloff_1_over_d", ...
  std::string message;  // what it is, and where to set it right
  double factor = 1.0;  // by which it makes the cards brighter
  std::optional<double> turn_deg{};  // of a panorama, from its front to its right
};

struct RenderVerdict {
  double lux = 0.0, expected_lx = 0.0;
  std::array<double, 3> rgb_lx{};  // of a perfectly white card; linear Rec. 709
  std::array<double, 2> card_lx{};
  // u95 that the picture itself leaves open (codes, noise), relative: of a card, clipped ones
  // absent, and of lux.
  std::array<std::optional<double>, 2> card_u95{};
  double lux_u95 = 0.0;
  std::optional<RenderedColor> color;      // of the cards, against what the lamps give them
  std::optional<RenderCause> color_cause;  // where that is off
  RenderCause cause;
  std::vector<RenderCause> alternatives;  // others that explain it as well
};

// Known mistakes of such a factor, the nearest first; where none is, exposure_unlocked. Beside a
// mistake of the very distance or angle of these cards, or of whole stops, other_intensity: what a
// changed intensity would look like, and which picture tells them apart.
[[nodiscard]] std::vector<RenderCause> CausesOfFactor(const CheckedRig& rig, double factor);

// Lux of the cards, Lambert: E = pi pixel/(reflectance scale). Clipped channels are left out; a
// tone curve shows in the ratio of the cards, a colour mistake in their tint, the rest by their
// factor. Off the axis of a spot its law is looked at, under a panorama which way round it stands
// (render_shape.h).   Refused: all_saturated, too_dark.
[[nodiscard]] Result<RenderVerdict> JudgeRender(const CheckedRig& rig,
                                                const std::array<CardPixels, 2>& cards,
                                                PixelUnit unit, const std::string& picture);

}  // namespace lightcal
