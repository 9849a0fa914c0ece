// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/compose_dome.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "lightcal/core/parallel.h"

namespace lightcal {
namespace {

constexpr int kSide = 2;                 // kSide x kSide directions of a pixel
constexpr double kLeastWeight = 1e-4;    // of a view's rim
constexpr double kLeastWorth = 1e-6;     // of the camera in its ball, where nothing else is seen
constexpr double kClippedWeight = 1e-9;  // where another view is not clipped
constexpr double kSamePlateau = 1e-4;    // clipped pixels are as bright as this, relative

// What the views show in one direction.
struct Mixture {
  std::array<double, 4> sum{};  // by channel, the last is luminance
  double weight = 0.0;
  bool clipped = true;
};

void Add(const AimedPicture& picture, double factor, const ViewScales& scales,
         const Vec3& direction, Mixture& mixture) {
  const auto sight = picture.view.See(direction);
  if (!sight) return;
  const PictureTap tap = TapAt(picture.view.angles().view(), sight->point);
  const bool clipped = AnyClipped(picture, tap);
  const double middle = 1.0 - sight->rim_share;
  // Shot noise: of one luminance, a view's variance is as what its samples are multiplied by.
  const double brightened = factor / scales.Falloff(sight->rim_share) / sight->passed;
  const double weight = (middle * middle + kLeastWeight) * std::max(sight->worth, kLeastWorth) *
                        (clipped ? kClippedWeight : 1.0) / brightened;
  const double gain = weight * brightened;
  const auto channels = static_cast<std::size_t>(picture.samples.channels());
  for (std::size_t k = 0; k < 4; ++k) {
    const double part = gain * double{tap.weight[k]};
    const float* const pixel = picture.samples.data() + tap.pixel[k] * channels;
    for (std::size_t c = 0; c < std::min<std::size_t>(channels, 3); ++c) {
      mixture.sum[c] += part * double{pixel[c]};
    }
    mixture.sum[3] += part * double{picture.nits.data()[tap.pixel[k]]};
  }
  mixture.weight += weight;
  mixture.clipped = mixture.clipped && clipped;
}

// A clipped light is one plateau again, as it was before it was sampled between pixels.
void LevelPlateau(ComposedDome& composed) {
  std::vector<float>& nits = composed.dome.nits;
  const float brightest = *std::max_element(nits.begin(), nits.end());
  for (std::size_t i = 0; i < nits.size(); ++i) {
    if (composed.clipped[i] != 0 &&
        nits[i] >= (1.0F - static_cast<float>(kSamePlateau)) * brightest)
      nits[i] = brightest;
  }
}

}  // namespace

int WidthForViews(std::span<const AimedPicture> views) {
  double finest = std::numbers::pi;
  for (const AimedPicture& picture : views) {
    finest = std::min(finest, picture.view.Pitch().value());
  }
  const int height = static_cast<int>(std::lround(std::numbers::pi / finest));
  return std::min(kMostDomeWidth, 2 * std::max(1, height));
}

ComposedDome ComposeDome(std::span<const AimedPicture> views, const ViewScales& scales, int width) {
  ComposedDome composed;
  Dome& dome = composed.dome;
  dome.width = width;
  dome.height = width / 2;
  dome.channels = views.front().samples.channels();
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(width / 2);
  const auto channels = static_cast<std::size_t>(dome.channels);
  dome.samples.assign(pixels * channels, 0.0F);
  dome.nits.assign(pixels, 0.0F);
  composed.clipped.assign(pixels, 0);
  composed.unseen.assign(pixels, 0);
  const LatLongGrid fine(width * kSide, width / 2 * kSide);
  ParallelFor(dome.height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      std::array<double, 4> sum{};
      int seen = 0;
      bool clipped = false;
      for (int i = 0; i < kSide * kSide; ++i) {
        const Vec3 direction = fine.Direction(x * kSide + i % kSide, y * kSide + i / kSide);
        Mixture mixture;
        for (std::size_t v = 0; v < views.size(); ++v) {
          Add(views[v], scales.factor[v], scales, direction, mixture);
        }
        if (!(mixture.weight > 0.0)) continue;
        ++seen;
        clipped = clipped || mixture.clipped;
        for (std::size_t c = 0; c < 4; ++c) sum[c] += mixture.sum[c] / mixture.weight;
      }
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x);
      composed.unseen[at] = seen == 0 ? 1 : 0;
      composed.clipped[at] = clipped ? 1 : 0;
      if (seen == 0) continue;
      for (std::size_t c = 0; c < std::min<std::size_t>(channels, 3); ++c) {
        dome.samples[at * channels + c] = static_cast<float>(sum[c] / seen);
      }
      dome.nits[at] = static_cast<float>(sum[3] / seen);
    }
  });
  LevelPlateau(composed);
  return composed;
}

}  // namespace lightcal
