// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/resample_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "lightcal/core/parallel.h"
#include "lightcal/imaging/bracket/cubic_weights.h"
#include "lightcal/imaging/bracket/noise_shares.h"
#include "lightcal/imaging/bracket/sampled.h"

namespace lightcal {
namespace {

constexpr float kCountedWeight = 0.02F;  // of a sample whose clipping spoils the sum
constexpr int kBorderStep = 8;

// The channel of a place of the colour pattern.
int ColorAt(const SignalFrame& frame, int x, int y) {
  return frame.channel[static_cast<std::size_t>(y % frame.row_period)]
                      [static_cast<std::size_t>(x % kLanes)];
}

// Sums over a lattice of one colour's samples.
class Lattice {
 public:
  Lattice(const std::vector<float>& samples, int width, int height, int channels, int channel,
          int period, int x, int y)
      : samples_(samples.data() + channel),
        row_(static_cast<std::size_t>(width) * static_cast<std::size_t>(channels)),
        step_(static_cast<std::size_t>(channels)),
        period_(period),
        x_(x),
        y_(y),
        columns_((width - x + period - 1) / period),
        rows_((height - y + period - 1) / period) {}

  // The sum at a place; infinity where a sample that counts is clipped.
  [[nodiscard]] float At(double x, double y, float clipped_from) const {
    const double u = (x - 0.5 - x_) / period_, v = (y - 0.5 - y_) / period_;
    const double left = std::floor(u), top = std::floor(v);
    const auto across = CubicWeightsAt(static_cast<float>(u - left));
    const auto down = CubicWeightsAt(static_cast<float>(v - top));
    float sum = 0.0F;
    for (int j = 0; j < 4; ++j) {
      const int row = std::clamp(static_cast<int>(top) - 1 + j, 0, rows_ - 1) * period_ + y_;
      const float* const line = samples_ + static_cast<std::size_t>(row) * row_;
      for (int i = 0; i < 4; ++i) {
        const int column =
            std::clamp(static_cast<int>(left) - 1 + i, 0, columns_ - 1) * period_ + x_;
        const float weight =
            across[static_cast<std::size_t>(i)] * down[static_cast<std::size_t>(j)];
        const float sample = line[static_cast<std::size_t>(column) * step_];
        if (sample >= clipped_from && std::abs(weight) > kCountedWeight) return HUGE_VALF;
        sum += weight * sample;
      }
    }
    return sum;
  }

 private:
  const float* samples_;
  std::size_t row_, step_;
  int period_, x_, y_, columns_, rows_;
};

// Every channel has its lattices.
std::array<std::vector<Lattice>, 3> LatticesOf(const SignalFrame& signals,
                                               const std::vector<float>& samples, int period) {
  std::array<std::vector<Lattice>, 3> lattices;
  if (period == 1) {
    for (int c = 0; c < signals.channels; ++c) {
      lattices[static_cast<std::size_t>(c)].emplace_back(samples, signals.width, signals.height,
                                                         signals.channels, c, 1, 0, 0);
    }
    return lattices;
  }
  for (int y = 0; y < period; ++y) {
    for (int x = 0; x < period; ++x) {
      lattices[static_cast<std::size_t>(ColorAt(signals, x, y))].emplace_back(
          samples, signals.width, signals.height, 1, 0, period, x, y);
    }
  }
  return lattices;
}

NoiseShares SharesOf(const SignalFrame& signals, const Homography& h, const Region& region,
                     int period) {
  NoiseShares shares;
  shares.from_reference = h;
  shares.x = region.x;
  shares.y = region.y;
  shares.period = period;
  if (period == 1) {
    shares.channels = signals.channels;
    for (int c = 0; c < signals.channels; ++c)
      shares.places[static_cast<std::size_t>(c)] = {{0, 0}};
    return shares;
  }
  shares.channels = 3;
  for (int y = 0; y < period; ++y) {
    for (int x = 0; x < period; ++x) {
      shares.places[static_cast<std::size_t>(ColorAt(signals, x, y))].emplace_back(x, y);
    }
  }
  return shares;
}

}  // namespace

int ColorPeriod(const SignalFrame& frame) {
  if (frame.channels != 1) return 1;
  for (const int period : {1, 2}) {
    bool repeats = true;
    for (int y = 0; repeats && y < std::max(frame.row_period, 2); ++y) {
      for (int x = 0; repeats && x < kLanes; ++x) {
        repeats = ColorAt(frame, x, y) == ColorAt(frame, x % period, y % period);
      }
    }
    if (repeats) return period;
  }
  return frame.row_period;
}

Region SharedRegion(std::span<const Homography> from_reference, int width, int height,
                    double margin) {
  int x0 = 0, y0 = 0, x1 = width, y1 = height;
  // A side moves in while a place on the border lies beyond that side of some frame.
  while (x1 > x0 && y1 > y0) {
    std::array<double, 4> beyond{};  // left, top, right, bottom
    for (const Homography& h : from_reference) {
      const auto see = [&](int x, int y) {
        const auto [u, v] = h(x, y);
        const std::array<double, 4> by = {margin - u, margin - v, u - (width - margin),
                                          v - (height - margin)};
        for (std::size_t i = 0; i < by.size(); ++i) beyond[i] = std::max(beyond[i], by[i]);
      };
      for (int x = x0; x < x1 + kBorderStep; x += kBorderStep) {
        see(std::min(x, x1), y0);
        see(std::min(x, x1), y1);
      }
      for (int y = y0; y < y1 + kBorderStep; y += kBorderStep) {
        see(x0, std::min(y, y1));
        see(x1, std::min(y, y1));
      }
    }
    if (*std::ranges::max_element(beyond) <= 0.0) break;
    const auto inwards = [&](std::size_t side) {
      return beyond[side] > 0.0 ? std::max(1, static_cast<int>(0.5 * beyond[side])) : 0;
    };
    x0 += inwards(0);
    y0 += inwards(1);
    x1 -= inwards(2);
    y1 -= inwards(3);
  }
  return {x0, y0, std::max(0, x1 - x0), std::max(0, y1 - y0)};
}

Result<void> ResampleFrame(const Homography& from_reference, const Region& region, Frame& frame,
                           SignalFrame& signals) {
  const int period = ColorPeriod(signals);
  if (period > 2) {
    return Refused("pattern_too_wide", signals.name,
                   "its colour filters repeat after " + std::to_string(period) +
                       " pixels; frames of such a sensor are not turned: shoot on a tripod");
  }
  std::vector<float> source(signals.row_samples() * static_cast<std::size_t>(signals.height));
  ParallelFor(signals.height, [&](int y) {
    ReadSignals(signals, y, 0,
                std::span(source).subspan(static_cast<std::size_t>(y) * signals.row_samples(),
                                          signals.row_samples()));
  });
  const auto lattices = LatticesOf(signals, source, period);
  const int channels = period == 1 ? signals.channels : 3;
  const std::size_t row_samples =
      static_cast<std::size_t>(region.width) * static_cast<std::size_t>(channels);
  auto samples =
      std::make_shared<std::vector<float>>(row_samples * static_cast<std::size_t>(region.height));
  ParallelFor(region.height, [&](int y) {
    float* out = samples->data() + static_cast<std::size_t>(y) * row_samples;
    for (int x = 0; x < region.width; ++x) {
      const auto [u, v] = from_reference(x + region.x + 0.5, y + region.y + 0.5);
      for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
        const float clip = signals.clip[c];
        float sum = 0.0F;
        for (const Lattice& lattice : lattices[c]) sum += lattice.At(u, v, kClippedFrom * clip);
        sum /= static_cast<float>(lattices[c].size());
        *out++ = std::isfinite(sum) ? sum : clip;
      }
    }
  });
  signals.shares =
      std::make_shared<const NoiseShares>(SharesOf(signals, from_reference, region, period));
  frame.samples = signals.samples =
      View2d<const float>(samples->data(), region.width, region.height, channels);
  frame.owner = std::move(samples);
  frame.in_file = false;
  frame.info.width = signals.width = region.width;
  frame.info.height = signals.height = region.height;
  frame.info.channels = signals.channels = channels;
  signals.row_period = signals.column_period = 1;
  signals.black.resize(1);
  signals.black[0].fill(0.0F);
  signals.scale.resize(1);
  signals.scale[0].fill(1.0F);
  signals.channel.resize(1);
  for (std::size_t i = 0; i < kLanes; ++i) {
    signals.channel[0][i] = static_cast<int>(i) % channels;
  }
  return {};
}

}  // namespace lightcal
