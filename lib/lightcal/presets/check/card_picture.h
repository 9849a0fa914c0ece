// SPDX-License-Identifier: Apache-2.0
// The rig's cards in a picture that an engine rendered of it.
#pragma once

#include <array>
#include <optional>

#include "lightcal/core/result.h"
#include "lightcal/presets/check/rig_file.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// Linear values of one card, mean of its middle half.
struct CardPixels {
  std::array<double, 3> rgb{};
  std::array<double, 3> raw{};  // the samples themselves over their top code; linear files: rgb
  std::array<bool, 3> clipped{};
  std::array<double, 3> step{};  // one code, linear; 0 of float files
  double spread = 0.0;           // relative standard deviation of green over the card
  double noise = 0.0;            // u95 of its mean by that spread, relative
};

// Pixels of the white and the grey card, linear Rec. 709 whatever the rig's pipeline works in.
// Encoded pictures (PNG, JPEG) are read as sRGB.
// Refused: cards_outside (a card's middle leaves the picture), not_color.
[[nodiscard]] Result<std::array<CardPixels, 2>> MeasureCards(const Frame& picture,
                                                             const CheckedRig& rig);

}  // namespace lightcal
