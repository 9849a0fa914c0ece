// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/camera/raw_patch.h"

#include <algorithm>
#include <cmath>

namespace lightcal {
namespace {

constexpr double kLostSigma = 0.9;     // a pixel's sigma / value where it says nothing
constexpr double kLargestLost = 0.01;  // share of such pixels

}  // namespace

Result<RawPatch> MeasureRawPatch(const MergedBracket& merged, const Region& region,
                                 const std::string& where) {
  if (auto inside = CheckRegion(region, merged.width, merged.height); !inside) {
    return Propagate(std::move(inside));
  }
  RawPatch patch;
  double squares = 0.0, variance = 0.0;
  int lost = 0;
  for (int y = region.y; y < region.y + region.height; ++y) {
    for (int x = region.x; x < region.x + region.width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(merged.width) +
                     static_cast<std::size_t>(x);
      const float* pixel = &merged.picture[3 * i];
      for (std::size_t c = 0; c < 3; ++c) patch.rgb[c] += double{pixel[c]};
      const double green = pixel[1], sigma = merged.sigma[i];
      squares += green * green;
      variance += sigma * sigma;
      if (!(sigma < kLostSigma * green)) ++lost;
    }
  }
  const double count = static_cast<double>(region.width) * region.height;
  if (!(patch.rgb[1] > 0.0) || lost > kLargestLost * count) {
    return Refused("patch_unreadable", where,
                   "its region is saturated in every frame or lost in the noise; expose shorter "
                   "or longer, or give the place with rect = [x, y, width, height]");
  }
  for (double& value : patch.rgb) value /= count;
  const double green = patch.rgb[1];
  patch.noise_sd = kInterpolatedNoise * std::sqrt(variance) / (count * green);
  patch.uneven_sd =
      std::sqrt(std::max(0.0, squares / count - green * green - variance / count)) / green;
  return patch;
}

Region MiddleOf(int width, int height) { return {width / 3, height / 3, width / 3, height / 3}; }

}  // namespace lightcal
