// SPDX-License-Identifier: Apache-2.0
// Pixels that are picked -> groups, by how near they are to each other on the sphere.
#pragma once

#include <functional>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/imaging/panorama/panorama.h"

namespace lightcal {

// Single linkage: two pixels that are at most `reach` apart are of one group, and so is a chain of
// such pairs. `picked`, row after row, is not 0 for the pixels to be grouped, each of which has a
// direction. The answer: groups 1, 2, ... in the order of their first pixels, 0 elsewhere.
// O(n log n) in the pixels of the groups' rims.
[[nodiscard]] std::vector<int> GroupPixels(const std::vector<char>& picked,
                                           const PixelSolidAngles& angles, Radians reach);

}  // namespace lightcal
