// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/fill_masked.h"

#include <algorithm>

namespace lightcal {

void FillMasked(std::span<const std::size_t> masked, std::size_t width, std::size_t channels,
                std::vector<float>& samples) {
  const auto is_masked = [&](std::size_t pixel) {
    return std::ranges::binary_search(masked, pixel);
  };
  for (const std::size_t pixel : masked) {
    const std::size_t begin = pixel / width * width, end = begin + width;
    std::size_t left = pixel, right = pixel;
    while (left > begin && is_masked(left)) --left;
    while (right + 1 < end && is_masked(right)) ++right;
    if (is_masked(left)) left = right;
    if (is_masked(right)) right = left;
    for (std::size_t c = 0; c < channels; ++c) {
      const bool none = is_masked(left);
      samples[pixel * channels + c] =
          none ? 0.0F : 0.5F * (samples[left * channels + c] + samples[right * channels + c]);
    }
  }
}

}  // namespace lightcal
