// SPDX-License-Identifier: Apache-2.0
// What several views of one place say of the cells of its sphere.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/imaging/panorama/aimed_picture.h"

namespace lightcal {

inline constexpr int kOverlapRows = 90, kOverlapColumns = 180;  // cells of 2 degrees

// The mean of a view over one cell that it shows whole.
struct OverlapSight {
  std::size_t view = 0;
  double ln = 0.0, variance = 0.0;  // of its luminance, in the view's own unit
  std::array<double, 3> radius{};   // r^2 r^4 r^6, r of RimShare
};

// By cell, row after row from the zenith, and in it by view. Unseen: the view shows no light of the
// whole cell; clipped: some of it is.
struct OverlapView {
  std::optional<OverlapSight> sight;
  bool clipped = false;
};
[[nodiscard]] std::vector<std::vector<OverlapView>> OverlapSights(
    std::span<const AimedPicture> views);

// Of a cell of this row, in cells of the equator.
[[nodiscard]] double OverlapCellArea(int row);

}  // namespace lightcal
