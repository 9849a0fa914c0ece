// SPDX-License-Identifier: Apache-2.0
// Pixels that hold no light, from those beside them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lightcal {

// Each masked pixel (ascending, y * width + x) becomes the mean of the nearest ones to both sides
// in its row that are not; 0 in a row that has none.
void FillMasked(std::span<const std::size_t> masked, std::size_t width, std::size_t channels,
                std::vector<float>& samples);

}  // namespace lightcal
