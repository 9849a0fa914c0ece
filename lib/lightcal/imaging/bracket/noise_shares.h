// SPDX-License-Identifier: Apache-2.0
// What is left of the samples' variance in a picture that was interpolated from them.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "lightcal/imaging/bracket/homography.h"

namespace lightcal {

// Catmull and Rom's weights of four neighbours at the share t between the middle two.
[[nodiscard]] constexpr std::array<float, 4> CubicWeightsAt(float t) {
  const float t2 = t * t, t3 = t2 * t;
  return {0.5F * (-t3 + 2.0F * t2 - t), 0.5F * (3.0F * t3 - 5.0F * t2 + 2.0F),
          0.5F * (-3.0F * t3 + 4.0F * t2 + t), 0.5F * (t3 - t2)};
}

struct NoiseShares {
  Homography from_reference;
  int x = 0, y = 0;  // where the picture's corner lies in the reference
  int channels = 1, period = 1;
  std::array<std::vector<std::pair<int, int>>, 3> places;  // of each channel's lattices

  // sum w^2 of samples [first, first + out.size()) of row y.
  void Row(int row, std::size_t first, std::span<float> out) const;
  // The mean over a picture of this size.
  [[nodiscard]] double Mean(int width, int height) const;
};

}  // namespace lightcal
