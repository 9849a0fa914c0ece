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
    // At the picture's edge what lies as far within as the hole reaches out here.
    const std::size_t past = (left > pixel ? left - pixel : pixel - left) - 1;
    if (left == right && left != pixel && left + past < end && left >= begin + past) {
      const std::size_t mirrored = left > pixel ? left + past : left - past;
      if (!is_masked(mirrored)) left = right = mirrored;
    }
    const bool none = is_masked(left);
    const float share =
        left == right ? 0.0F : static_cast<float>(pixel - left) / static_cast<float>(right - left);
    for (std::size_t c = 0; c < channels; ++c) {
      const float a = samples[left * channels + c], b = samples[right * channels + c];
      samples[pixel * channels + c] = none ? 0.0F : a + share * (b - a);
    }
  }
}

}  // namespace lightcal
