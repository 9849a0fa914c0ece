// SPDX-License-Identifier: Apache-2.0
// Regions of a picture of luminances -> numbers.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/view2d.h"
#include "lightcal/imaging/panorama/panorama.h"

namespace lightcal {

// Pixels x to x + width - 1, y to y + height - 1; (0, 0) is the upper left one.
struct Region {
  int x = 0, y = 0, width = 0, height = 0;

  [[nodiscard]] bool Holds(int at_x, int at_y) const {
    return at_x >= x && at_x < x + width && at_y >= y && at_y < y + height;
  }
};

struct LuminanceStatistics {
  Nits min, mean, median, max;  // of an even count, the median is the middle two's mean
  double sd_relative = 0.0;  // standard deviation of the pixels / mean; 0 where mean is not above 0
  int peak_x = 0, peak_y = 0;  // the first pixel that has max, row by row
};

// Refused: bad_region (empty, or not inside the picture).
[[nodiscard]] Result<void> CheckRegion(const Region& region, int width, int height);

// Sums in double, row by row. Pixels of NaN are masked and left out.
// Refused: bad_region, all_masked (no pixel of the region is left).
[[nodiscard]] Result<LuminanceStatistics> MeasureRegion(View2d<const float> nits,
                                                        const Region& region);

struct RegionIlluminance {
  Lux illuminance;            // of the plane that faces the axis (for lat-long: lies flat), by the
                              // region alone:  E = sum of L cos(theta) dOmega
  Steradians solid_angle{0};  // of the whole region, behind the plane too; without masked pixels
};
// Refused: bad_region, bad_view (picture and solid angles differ in size).
[[nodiscard]] Result<RegionIlluminance> MeasureIlluminance(View2d<const float> nits,
                                                           const PixelSolidAngles& angles,
                                                           const Region& region);

}  // namespace lightcal
