// SPDX-License-Identifier: Apache-2.0
// A picture with fewer pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "lightcal/imaging/panorama/dome_lights.h"

namespace lightcal {

// Means of blocks of step x step pixels around the picture's middle; what is over at its edges is
// left out.
[[nodiscard]] Dome ReducedDome(const Dome& dome, int step);
// 1 where any pixel of a block is marked.
[[nodiscard]] std::vector<std::uint8_t> ReducedMarks(const std::vector<std::uint8_t>& marks,
                                                     int width, int height, int step);

}  // namespace lightcal
