// SPDX-License-Identifier: Apache-2.0
// The places of a picture that can be found again, and what they look like.
#pragma once

#include <cstdint>
#include <vector>

#include "lightcal/core/view2d.h"
#include "lightcal/records/picture_feature.h"

namespace lightcal {

// SIFT of a grey picture where `seen` is not 0, strongest first. Spread over the picture: at most
// `most` in all, and in each of 8 x 8 fields at most a thirtieth of them, so that one window does
// not take them all.   Source: Lowe, IJCV 60 (2004); OpenCV's.
[[nodiscard]] std::vector<PictureFeature> FindFeatures(View2d<const std::uint8_t> grey,
                                                       View2d<const std::uint8_t> seen, int most);

}  // namespace lightcal
