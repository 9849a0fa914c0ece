// SPDX-License-Identifier: Apache-2.0
// Aimed pictures on one scale -> one lat-long panorama.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightcal/imaging/panorama/aimed_picture.h"
#include "lightcal/imaging/panorama/dome_lights.h"
#include "lightcal/imaging/panorama/view_scales.h"

namespace lightcal {

struct ComposedDome {
  Dome dome;                          // 0 where no view looks
  std::vector<std::uint8_t> clipped;  // by pixel: no view that looks there is unclipped
  std::vector<std::uint8_t> unseen;   // by pixel
};

inline constexpr int kMostDomeWidth = 8192;

// The width at which no view loses detail in its middle: 2 pi over its finest pixel, even, at most
// kMostDomeWidth.
[[nodiscard]] int WidthForViews(std::span<const AimedPicture> views);

// Each pixel is the mean of 2 x 2 directions; each of those the mean of the views that show it,
// weighted by (1 - RimShare)^2, so that no seam is left, over the variance that shot noise gives
// one luminance there (as factor / fall-off); clipped samples count where there is no
// other. Every view has the same channels and colours, as dome.xyz_from_rgb has them.
// Holds for an even width above 1.
[[nodiscard]] ComposedDome ComposeDome(std::span<const AimedPicture> views,
                                       const ViewScales& scales, int width);

}  // namespace lightcal
