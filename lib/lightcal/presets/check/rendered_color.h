// SPDX-License-Identifier: Apache-2.0
// The colour of a rig's cards in a picture against what its lamps give them.
#pragma once

#include <array>
#include <optional>

#include "lightcal/presets/check/card_picture.h"
#include "lightcal/presets/check/rig_file.h"

namespace lightcal {

struct RenderedColor {
  // Between the two in the CIE 1976 u'v' plane; allowed: u95 of the lamps' colours by their shares
  // of the light, what the picture leaves open, and .002 for roundings of files and engines.
  double apart_uv = 0.0, allowed_uv = 0.0;

  [[nodiscard]] bool Off() const { return apart_uv > allowed_uv; }
};

// Half a code or the noise of a card's mean, relative, u95; `channel` by channel.
[[nodiscard]] double UnsureOfCard(const CardPixels& card, std::size_t channel);

// What lamps other than `but` give a white card, linear Rec. 709 over the light of all: sum of
// share_k c_k/Y_k. Absent where the file does not say what each lamp gives.
[[nodiscard]] std::optional<std::array<double, 3>> LightOfLamps(const CheckedRig& rig,
                                                                std::optional<std::size_t> but);

// `rgb`: of a white card, linear, of any length. Absent under panoramas, whose colours are judged
// with the way they hang (render_shape.h), of black and of older files.
[[nodiscard]] std::optional<RenderedColor> ColorOfCards(const CheckedRig& rig,
                                                        const std::array<CardPixels, 2>& cards,
                                                        const std::array<double, 3>& rgb);

}  // namespace lightcal
