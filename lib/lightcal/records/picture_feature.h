// SPDX-License-Identifier: Apache-2.0
// A place of a picture that another picture of the same things shows again.
#pragma once

#include <array>

namespace lightcal {

struct PictureFeature {
  float x = 0.0F, y = 0.0F;             // pixel centres at .5
  float size = 0.0F;                    // diameter of what was looked at, pixels
  float strength = 0.0F;                // the detector's, for choosing the best
  std::array<float, 128> descriptor{};  // of unit length: alike places have a product near 1
};

}  // namespace lightcal
