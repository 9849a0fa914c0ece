// SPDX-License-Identifier: Apache-2.0
// Pixels that hold no light, from those beside them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lightcal {

// Each masked pixel (ascending, y * width + x) lies on the straight line between the nearest ones
// to both sides in its row that are not, and mirrors its row at the picture's edge: holes of one
// value would look as if the picture were cut off there. 0 in a row that has none.
void FillMasked(std::span<const std::size_t> masked, std::size_t width, std::size_t channels,
                std::vector<float>& samples);

}  // namespace lightcal
