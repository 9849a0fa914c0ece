// SPDX-License-Identifier: Apache-2.0
// Where a dome made of views shows nothing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightcal/core/vec3.h"
#include "lightcal/imaging/panorama/latlong_grid.h"

namespace lightcal {

struct DomeHole {
  Vec3 direction{};    // of its middle
  double share = 0.0;  // of the sphere
};

// Connected fields of 3 degrees, more than half of each unseen, the largest first; those of less
// than 1e-4 of the sphere are left out. `unseen` has a mark for each pixel of the grid.
[[nodiscard]] std::vector<DomeHole> HolesOf(std::span<const std::uint8_t> unseen,
                                            const LatLongGrid& grid);

}  // namespace lightcal
