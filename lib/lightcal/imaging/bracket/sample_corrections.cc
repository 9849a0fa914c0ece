// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/sample_corrections.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "lightcal/imaging/camera/flat_field.h"

namespace lightcal {
namespace {

constexpr int kNeighboursTried = 4;
// So many beside each other, of one colour, are bridged: of more nobody knows what they would show.
constexpr int kMostBridged = 2;

}  // namespace

void SampleCorrections::AddHotPixels(std::span<const int> hot_pixels) {
  for (std::size_t i = 0; i + 1 < hot_pixels.size(); i += 2) {
    hot_.emplace_back(hot_pixels[i + 1] - y_, hot_pixels[i] - x_);
  }
  std::ranges::sort(hot_);
  hot_.erase(std::unique(hot_.begin(), hot_.end()), hot_.end());
}

void SampleCorrections::SetThinning(const Thinning& thinning) {
  thinning_ = thinning;
  // The smaller picture's column (row) that holds one of the whole picture; absent if left out.
  const auto shown = [&](int at, int period) -> std::optional<int> {
    const int block = at / period;
    if (!thinning.averaged && block % thinning.n != 0) return std::nullopt;
    return block / thinning.n * period + at % period;
  };
  std::vector<std::pair<int, int>> kept;
  for (const auto& [y, x] : hot_) {
    const auto thin_y = shown(y, thinning.rows), thin_x = shown(x, thinning.columns);
    if (thin_y && thin_x) kept.emplace_back(*thin_y, *thin_x);
  }
  hot_ = std::move(kept);
  std::ranges::sort(hot_);
  hot_.erase(std::unique(hot_.begin(), hot_.end()), hot_.end());
}

void SampleCorrections::Apply(const SignalFrame& frame, int y, float* value,
                              float* variance) const {
  if (!hot_.empty()) ReplaceHot(frame, y, value, variance);
  if (flat_) return Flatten(frame, y, value, variance);
  if (black_sd_ == 0.0) return;
  const auto black = static_cast<float>(black_sd_ * black_sd_);
  for (std::size_t i = 0; i < frame.row_samples(); ++i) variance[i] += black;
}

void SampleCorrections::ReplaceHot(const SignalFrame& frame, int y, float* value,
                                   float* variance) const {
  const auto first = std::ranges::lower_bound(hot_, std::pair{y, std::numeric_limits<int>::min()});
  const auto& channel = frame.channel[static_cast<std::size_t>(y % frame.row_period)];
  const auto is_hot = [&](int x) { return std::ranges::binary_search(hot_, std::pair{y, x}); };
  for (auto it = first; it != hot_.end() && it->first == y; ++it) {
    if (it->second < 0 || it->second >= frame.width) continue;
    for (int c = 0; c < frame.channels; ++c) {
      const int at = it->second * frame.channels + c;
      const int color = channel[static_cast<std::size_t>(at % kLanes)];
      // The nearest sample of the same colour to one side that is not hot itself.
      int lost = 1;
      const auto nearest = [&](int step) -> std::optional<int> {
        int found = 0;
        for (int x = it->second + step; x >= 0 && x < frame.width; x += step) {
          const int i = x * frame.channels + c;
          if (channel[static_cast<std::size_t>(i % kLanes)] != color) continue;
          if (!is_hot(x)) return i;
          ++lost;
          if (++found == kNeighboursTried) break;
        }
        return std::nullopt;
      };
      const auto left = nearest(-1), right = nearest(1);
      if (!left && !right) {
        variance[at] = value[at] * value[at];
        continue;
      }
      const float a = value[left.value_or(right.value_or(at))];
      const float b = value[right.value_or(left.value_or(at))];
      const float var_a = variance[left.value_or(right.value_or(at))];
      const float var_b = variance[right.value_or(left.value_or(at))];
      value[at] = 0.5F * (a + b);
      const bool both = left && right;  // on the edge one stands alone, and nothing tells the slope
      variance[at] = both ? 0.25F * (var_a + var_b + (a - b) * (a - b)) : 2.0F * var_a;
      if (lost > kMostBridged) variance[at] += value[at] * value[at];
    }
  }
}

void SampleCorrections::Flatten(const SignalFrame& frame, int y, float* value,
                                float* variance) const {
  const auto& channel = frame.channel[static_cast<std::size_t>(y % frame.row_period)];
  const auto black = static_cast<float>(black_sd_ * black_sd_);
  const auto sigma2 = static_cast<float>(flat_->sigma_relative * flat_->sigma_relative);
  const std::size_t samples = frame.row_samples();
  for (std::size_t i = 0; i < samples; ++i) {
    const int x = static_cast<int>(i / static_cast<std::size_t>(frame.channels));
    const FlatPlace place = FlatPlaceOf(thinning_.WholeX(x) + x_, thinning_.WholeY(y) + y_,
                                        whole_width_, whole_height_);
    const auto color = static_cast<std::size_t>(channel[i % kLanes]);
    const auto gain = static_cast<float>(1.0 / LightThrough(*flat_, color, place));
    value[i] *= gain;
    variance[i] = (variance[i] + black) * gain * gain + sigma2 * value[i] * value[i];
  }
}

}  // namespace lightcal
