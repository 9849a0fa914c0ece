// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/wall_shadows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/imaging/scene/wall_samples.h"

namespace lightcal {
namespace {

// The darkest quarter of a shadow's pixels, which no half shadow reaches; its noise left out below.
WallBlock DarkestOf(View2d<const float> nits, const Region& shadow) {
  std::vector<float> values;
  for (int y = shadow.y; y < shadow.y + shadow.height; ++y) {
    for (int x = shadow.x; x < shadow.x + shadow.width; ++x) values.push_back(nits(x, y));
  }
  std::ranges::sort(values);
  const std::size_t from = values.size() / 20, to = std::max(from + 1, values.size() / 4);
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = from; i < to; ++i) {
    sum += double{values[i]};
    squares += double{values[i]} * double{values[i]};
  }
  const auto n = static_cast<double>(to - from);
  const double mean = sum / n;
  return {{shadow.x + 0.5 * shadow.width, shadow.y + 0.5 * shadow.height},
          mean,
          std::sqrt(std::max(0.0, squares / n - mean * mean))};
}

}  // namespace

Result<std::vector<SeenPlace>> SeenInShadows(const CaptureDescription& capture,
                                             const WallPicture& picture, const WallModel& model,
                                             const std::vector<SeenPlace>& lit) {
  constexpr double kDarker = 0.9;
  WallBlocks shadows;
  for (const auto& r : capture.wall->shadows) {
    const Region region = ThinRegion({r[0], r[1], r[2], r[3]}, picture.thinning);
    if (auto inside = CheckRegion(region, picture.nits.width, picture.nits.height); !inside) {
      return Propagate(std::move(inside));
    }
    shadows.blocks.push_back(DarkestOf(picture.nits.view(), region));
  }
  std::vector<SeenPlace> places = PlacesSeen(shadows, model);
  if (places.size() < capture.wall->shadows.size()) {
    return Refused("bad_region", "wall.shadows", "a shadow lies off the wall, or too far aside");
  }
  for (const SeenPlace& shadow : places) {
    const auto apart = [&](const SeenPlace& place) {
      return std::hypot(place.x_m - shadow.x_m, place.z_m - shadow.z_m);
    };
    if (!lit.empty() && shadow.lux > kDarker * std::ranges::min(lit, {}, apart).lux) {
      return Refused("bad_region", "wall.shadows",
                     "is hardly darker than the wall beside it: give a box around the card's "
                     "shadow, [x, y, width, height] in pixels from the upper left corner");
    }
  }
  return places;
}

}  // namespace lightcal
