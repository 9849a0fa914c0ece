// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/thin_frame.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "lightcal/imaging/bracket/sampled.h"

namespace lightcal {
namespace {

template <class Sample>
Frame Kept(const Frame& frame, View2d<const Sample> from, const Thinning& thinning) {
  Frame out;
  out.info = frame.info;
  out.info.width = thinning.width;
  out.info.height = thinning.height;
  const auto channels = static_cast<std::size_t>(from.channels());
  const auto pixels =
      static_cast<std::size_t>(thinning.width) * static_cast<std::size_t>(thinning.height);
  auto samples = std::make_shared<std::vector<Sample>>(pixels * channels);
  const View2d<Sample> to(samples->data(), thinning.width, thinning.height, from.channels());
  for (int y = 0; y < thinning.height; ++y) {
    const int from_y = y / thinning.rows * thinning.rows * thinning.n + y % thinning.rows;
    for (int x = 0; x < thinning.width; ++x) {
      const int from_x =
          x / thinning.columns * thinning.columns * thinning.n + x % thinning.columns;
      for (int c = 0; c < from.channels(); ++c) to(x, y, c) = from(from_x, from_y, c);
    }
  }
  out.samples = View2d<const Sample>(to);
  out.owner = std::move(samples);
  return out;
}

// Sums of a row of blocks, and the largest sample in each.
class BlockRow {
 public:
  BlockRow(const Thinning& thinning, std::size_t channels)
      : n_(static_cast<std::size_t>(thinning.n)),
        place_samples_(static_cast<std::size_t>(thinning.columns) * channels),
        sums_(static_cast<std::size_t>(thinning.width) * channels),
        most_(sums_.size()) {}

  void Clear() {
    std::ranges::fill(sums_, 0.0);
    std::ranges::fill(most_, -std::numeric_limits<float>::infinity());
  }
  void Add(std::span<const float> row) {
    for (std::size_t block = 0; block * place_samples_ < sums_.size(); ++block) {
      double* sum = sums_.data() + block * place_samples_;
      float* most = most_.data() + block * place_samples_;
      const float* from = row.data() + block * n_ * place_samples_;
      for (std::size_t i = 0; i < n_ * place_samples_; i += place_samples_) {
        for (std::size_t place = 0; place < place_samples_; ++place) {
          sum[place] += double{from[i + place]};
          most[place] = std::max(most[place], from[i + place]);
        }
      }
    }
  }
  // `channel` of each lane of the row, as SignalFrame has it.
  void Mean(const std::array<int, kLanes>& channel, const std::array<float, 4>& clip,
            std::span<float> out) const {
    const double share = 1.0 / static_cast<double>(n_ * n_);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const float full = clip[static_cast<std::size_t>(channel[i % kLanes])];
      out[i] = most_[i] < kClippedFrom * full ? static_cast<float>(sums_[i] * share) : full;
    }
  }

 private:
  std::size_t n_, place_samples_;
  std::vector<double> sums_;
  std::vector<float> most_;
};

// Samples that are signals: black is 0, white is 1.
void SayTheyAreSignals(FrameInfo& info) {
  info.radiance_exposure = 1.0;
  if (!info.levels) return;
  info.levels->black = {1, 1, {0.0F}};
  info.levels->white.fill(1.0F);
  info.levels->maximum = 1.0F;
}

}  // namespace

double Thinning::Whole(int at, int period) const {
  const double first = 1.0 * (at / period) * n * period + at % period + 0.5;
  return averaged ? first + 0.5 * period * (n - 1) : first;
}

double Thinning::Thin(double whole, int period) const {
  return (whole + (averaged ? 0.0 : 0.5 * period * (n - 1))) / n;
}

Thinning ThinningOf(const FrameInfo& info, const PictureChoice& choice) {
  const auto [columns, rows] = PixelPeriod(info);
  const int n = choice.pixel_stride;
  const bool too_small = info.width < columns * n || info.height < rows * n;
  if (n <= 1 || too_small) {
    return {.columns = columns, .rows = rows, .width = info.width, .height = info.height};
  }
  return {.n = n,
          .averaged = choice.average_pixels,
          .columns = columns,
          .rows = rows,
          .width = info.width / (columns * n) * columns,
          .height = info.height / (rows * n) * rows};
}

Frame ThinFrame(const Frame& frame, const Thinning& thinning) {
  if (thinning.n == 1) return frame;
  return std::visit([&](const auto& from) { return Kept(frame, from, thinning); }, frame.samples);
}

void AverageFrame(const Thinning& thinning, Frame& frame, SignalFrame& signals) {
  if (thinning.n == 1) return;
  const auto channels = static_cast<std::size_t>(signals.channels);
  const std::size_t row_samples = static_cast<std::size_t>(thinning.width) * channels;
  auto samples =
      std::make_shared<std::vector<float>>(row_samples * static_cast<std::size_t>(thinning.height));
  std::vector<float> row(signals.row_samples());
  BlockRow blocks(thinning, channels);
  for (int y = 0; y < thinning.height; ++y) {
    blocks.Clear();
    const int first = y / thinning.rows * thinning.rows * thinning.n + y % thinning.rows;
    for (int i = 0; i < thinning.n; ++i) {
      ReadSignals(signals, first + i * thinning.rows, 0, row);
      blocks.Add(row);
    }
    blocks.Mean(
        signals.channel[static_cast<std::size_t>(y % signals.row_period)], signals.clip,
        std::span(*samples).subspan(static_cast<std::size_t>(y) * row_samples, row_samples));
  }
  frame.info.width = signals.width = thinning.width;
  frame.info.height = signals.height = thinning.height;
  frame.samples = signals.samples =
      View2d<const float>(samples->data(), thinning.width, thinning.height, signals.channels);
  frame.owner = std::move(samples);
  frame.in_file = false;
  SayTheyAreSignals(frame.info);
  for (auto& black : signals.black) black.fill(0.0F);
  for (auto& scale : signals.scale) scale.fill(1.0F);
  signals.response = nullptr;
}

Region ThinRegion(const Region& region, const Thinning& thinning) {
  if (thinning.n == 1) return region;
  const auto inner = [&](int start, int length, int period, int thinned) {
    const int whole = period * thinning.n;
    const int first = (start + whole - 1) / whole * period;
    const int last = std::min((start + length) / whole * period, thinned);
    if (last > first) return std::pair(first, last - first);
    return std::pair(std::min((start + length / 2) / whole * period, thinned - period), period);
  };
  const auto [x, width] = inner(region.x, region.width, thinning.columns, thinning.width);
  const auto [y, height] = inner(region.y, region.height, thinning.rows, thinning.height);
  return {x, y, width, height};
}

}  // namespace lightcal
