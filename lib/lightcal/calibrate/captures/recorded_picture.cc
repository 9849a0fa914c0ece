// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/recorded_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/imaging/bracket/merge_frames.h"
#include "lightcal/report/contours.h"

namespace lightcal {
namespace {

// Of a large picture every n-th pixel each way is looked at: so many a side of a kept pixel.
constexpr int kSamplesPerSide = 3;

// Luminance at every n-th pixel; what is not finite (a lost pixel) is dark.
struct Thinned {
  int width, height;
  std::vector<float> nits;
};
template <class LuminanceAt>
Thinned Thin(int width, int height, const LuminanceAt& luminance_at) {
  const int n = std::max(1, std::max(width, height) / (kSamplesPerSide * kLongestRecordedSide));
  Thinned out{std::max(1, width / n), std::max(1, height / n), {}};
  out.nits.reserve(static_cast<std::size_t>(out.width) * out.height);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const double nits = luminance_at(x * n, y * n);
      out.nits.push_back(std::isfinite(nits) ? static_cast<float>(nits) : 0.0F);
    }
  }
  return out;
}

RecordedPicture Small(const CaptureDescription& capture, int width, const Thinned& thinned) {
  report::ReducedField reduced =
      report::Reduce({thinned.nits.data(), thinned.width, thinned.height}, kLongestRecordedSide);
  RecordedPicture out;
  out.light = capture.light;
  out.use = kCaptureUseWords[static_cast<std::size_t>(capture.use)];
  out.width = reduced.width;
  out.height = reduced.height;
  out.nits = std::move(reduced.samples);
  if (capture.rect) {
    const double scale = static_cast<double>(out.width) / width;
    const auto& r = *capture.rect;
    out.region = {{r[0] * scale, r[1] * scale, r[2] * scale, r[3] * scale}};
  }
  return out;
}

}  // namespace

RecordedPicture RecordedOf(const CaptureDescription& capture, View2d<const float> nits) {
  const auto luminance_at = [&](int x, int y) { return double{nits(x, y)}; };
  return Small(capture, nits.width(), Thin(nits.width(), nits.height(), luminance_at));
}

RecordedPicture RecordedOf(const CaptureDescription& capture, const MergedBracket& merged,
                           double factor) {
  const auto luminance_at = [&](int x, int y) {
    const auto pixel = static_cast<std::size_t>(y) * merged.width + x;
    const float* p = &merged.picture[pixel * static_cast<std::size_t>(merged.channels)];
    const double luminance =
        merged.channels == 3 ? LuminanceOfRgb({p[0], p[1], p[2]}, RgbSpace::kSrgb) : double{p[0]};
    return factor * luminance;
  };
  return Small(capture, merged.width, Thin(merged.width, merged.height, luminance_at));
}

}  // namespace lightcal
