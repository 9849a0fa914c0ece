// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "lightcal/core/statistics.h"
#include "lightcal/records/stored_pixels.h"

namespace lightcal {

Result<void> CheckRegion(const Region& region, int width, int height) {
  if (IsInside({region.x, region.y, region.width, region.height}, width, height)) return {};
  const auto text = [](int v) { return std::to_string(v); };
  return Refused(
      "bad_region",
      text(region.x) + "," + text(region.y) + "," + text(region.width) + "," + text(region.height),
      "the region x,y,w,h must lie inside the picture of " + text(width) + " x " + text(height) +
          " pixels");
}

Result<LuminanceStatistics> MeasureRegion(View2d<const float> nits, const Region& region) {
  if (auto ok = CheckRegion(region, nits.width(), nits.height()); !ok) {
    return Propagate(std::move(ok));
  }
  const View2d<const float> part = nits.Crop(region.x, region.y, region.width, region.height);
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(region.width) * region.height);
  LuminanceStatistics statistics;
  float most = -std::numeric_limits<float>::infinity();
  for (int y = 0; y < part.height(); ++y) {
    for (int x = 0; x < part.width(); ++x) {
      const float v = part(x, y);
      if (std::isnan(v)) continue;
      values.push_back(v);
      if (!(v > most)) continue;
      most = v;
      statistics.peak_x = region.x + x;
      statistics.peak_y = region.y + y;
    }
  }
  if (values.empty()) {
    return Refused("all_masked", "region", "none of its pixels holds a number; choose another");
  }
  double sum = 0.0;
  for (const float v : values) sum += v;
  const double count = static_cast<double>(values.size());
  const double mean = sum / count;
  double squares = 0.0;
  for (const float v : values) squares += (v - mean) * (v - mean);

  statistics.min = Nits(*std::min_element(values.begin(), values.end()));
  statistics.max = Nits(most);
  statistics.mean = Nits(mean);
  statistics.sd_relative = mean > 0.0 ? std::sqrt(squares / count) / mean : 0.0;
  statistics.median = Nits(Median(values));
  return statistics;
}

Result<RegionIlluminance> MeasureIlluminance(View2d<const float> nits,
                                             const PixelSolidAngles& angles, const Region& region) {
  if (auto ok = CheckRegion(region, nits.width(), nits.height()); !ok) {
    return Propagate(std::move(ok));
  }
  if (angles.view().width != nits.width() || angles.view().height != nits.height()) {
    return Refused("bad_view", "projection", "picture and projection differ in size");
  }
  double lux = 0.0, solid_angle = 0.0;
  for (int y = region.y; y < region.y + region.height; ++y) {
    for (int x = region.x; x < region.x + region.width; ++x) {
      if (std::isnan(nits(x, y))) continue;
      lux += nits(x, y) * angles.ProjectedSolidAngle(x, y);
      solid_angle += angles.SolidAngle(x, y);
    }
  }
  return RegionIlluminance{Lux(lux), Steradians(solid_angle)};
}

}  // namespace lightcal
