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
