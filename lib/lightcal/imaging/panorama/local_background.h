// SPDX-License-Identifier: Apache-2.0
// What a lat-long panorama would look like around each place without the small bright things there.
#pragma once

#include <vector>

#include "lightcal/core/view2d.h"
#include "lightcal/imaging/panorama/latlong_grid.h"

namespace lightcal {

class LocalBackground {
 public:
  // The medians of 3 degree cells; then, for each cell, the 70th percentile (by solid angle) of
  // those within 25 degrees.
  LocalBackground(View2d<const float> nits, const LatLongGrid& grid);
  // Linear between the cells' middles; a percentile below 0 counts as 0.
  [[nodiscard]] double At(int x, int y) const;

 private:
  LatLongGrid cells_;
  double cells_per_x_, cells_per_y_;
  std::vector<double> value_;
};

}  // namespace lightcal
