// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/motion_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "lightcal/core/parallel.h"
#include "lightcal/imaging/bracket/sampled.h"

namespace lightcal {
namespace {

constexpr int kCoarsest = 48;        // cells on the longer side
constexpr double kLeastClear = 4.0;  // signal over noise of a cell whose logarithm says something

// Signals and variances of cells; a negative variance: clipped.
struct MotionCells {
  int width = 0, height = 0;
  double cell = 1.0;
  std::vector<float> mean, variance;
};

// Of one cell, for each channel.
struct ChannelSums {
  std::array<double, 4> sum{}, count{};
  std::array<bool, 4> clipped{};
};

// A cell's mean and its variance, negative where it is clipped.
std::pair<double, double> CellOf(const ChannelSums& cell, MotionChannels channels,
                                 const NoiseProfile& noise) {
  double sum = 0.0, count = 0.0;
  bool clipped = false;
  std::size_t least = 0;
  for (std::size_t c = 0; c < cell.sum.size(); ++c) {
    if (!(cell.count[c] > 0.0)) continue;
    sum += cell.sum[c];
    count += cell.count[c];
    clipped = clipped || cell.clipped[c];
    if (!(cell.count[least] > 0.0) ||
        cell.sum[c] * cell.count[least] < cell.sum[least] * cell.count[c]) {
      least = c;
    }
  }
  if (channels == MotionChannels::kDarkest) {
    sum = cell.sum[least];
    count = cell.count[least];
    clipped = cell.clipped[least];
  }
  const double mean = sum / count;
  if (clipped) return {mean, -1.0};
  return {mean, (noise.scale * std::max(mean, 0.0) + noise.offset) / count};
}

MotionCells MotionCellsOf(const SignalFrame& frame, const NoiseProfile& noise, int longest,
                          MotionChannels channels) {
  const int period = std::lcm(frame.row_period, frame.column_period);
  const int least = (std::max(frame.width, frame.height) + longest - 1) / longest;
  const int size = std::max(1, (least + period - 1) / period * period);
  MotionCells cells;
  cells.width = frame.width / size;
  cells.height = frame.height / size;
  cells.cell = size;
  const auto across = static_cast<std::size_t>(cells.width);
  cells.mean.resize(across * static_cast<std::size_t>(cells.height));
  cells.variance.resize(cells.mean.size());
  const auto samples = static_cast<std::size_t>(size * frame.channels);
  ParallelFor(cells.height, [&](int y) {
    std::vector<float> row(frame.row_samples());
    std::vector<ChannelSums> sums(across);
    for (int j = 0; j < size; ++j) {
      ReadSignals(frame, y * size + j, 0, row);
      const auto& channel =
          frame.channel[static_cast<std::size_t>((y * size + j) % frame.row_period)];
      for (std::size_t at = 0; at < across * samples; ++at) {
        ChannelSums& cell = sums[at / samples];
        const auto c = static_cast<std::size_t>(channel[at % kLanes]);
        cell.sum[c] += double{row[at]};
        cell.count[c] += 1.0;
        if (row[at] >= kClippedFrom * frame.clip[c]) cell.clipped[c] = true;
      }
    }
    for (std::size_t x = 0; x < across; ++x) {
      const auto [mean, variance] = CellOf(sums[x], channels, noise);
      const std::size_t at = static_cast<std::size_t>(y) * across + x;
      cells.mean[at] = static_cast<float>(mean);
      cells.variance[at] = static_cast<float>(variance);
    }
  });
  return cells;
}

MotionCells Halved(const MotionCells& from) {
  MotionCells out;
  out.width = from.width / 2;
  out.height = from.height / 2;
  out.cell = 2.0 * from.cell;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      // Of what is not clipped, where that is half: a few lamps must not blind a coarse picture.
      float mean = 0.0F, variance = 0.0F, count = 0.0F;
      for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
          const std::size_t at =
              static_cast<std::size_t>(2 * y + j) * static_cast<std::size_t>(from.width) +
              static_cast<std::size_t>(2 * x + i);
          if (from.variance[at] < 0.0F) continue;
          mean += from.mean[at];
          variance += from.variance[at];
          count += 1.0F;
        }
      }
      out.mean.push_back(count > 0.0F ? mean / count : 0.0F);
      out.variance.push_back(count >= 2.0F ? variance / (count * count) : -1.0F);
    }
  }
  return out;
}

MotionPicture Logarithms(const MotionCells& cells, double floor) {
  MotionPicture picture{cells.width, cells.height, cells.cell, {}, {}};
  picture.ln.resize(cells.mean.size());
  picture.variance.assign(cells.mean.size(), -1.0F);
  for (std::size_t i = 0; i < cells.mean.size(); ++i) {
    const double mean = cells.mean[i], variance = cells.variance[i];
    const bool clear =
        variance >= 0.0 && mean > floor && mean * mean > kLeastClear * kLeastClear * variance;
    if (!clear) continue;
    picture.ln[i] = static_cast<float>(std::log(mean));
    picture.variance[i] = static_cast<float>(variance / (mean * mean));
  }
  return picture;
}

}  // namespace

MotionPyramid MotionPyramidOf(const SignalFrame& frame, const NoiseProfile& noise, double floor,
                              int longest, MotionChannels channels) {
  MotionPyramid pyramid;
  MotionCells cells = MotionCellsOf(frame, noise, longest, channels);
  pyramid.levels.push_back(Logarithms(cells, floor));
  const auto& finest = pyramid.levels.front().variance;
  pyramid.seen =
      static_cast<double>(std::ranges::count_if(finest, [](float v) { return v >= 0.0F; })) /
      static_cast<double>(std::max<std::size_t>(finest.size(), 1));
  while (std::max(cells.width, cells.height) >= 2 * kCoarsest &&
         std::min(cells.width, cells.height) >= 16) {
    cells = Halved(cells);
    pyramid.levels.push_back(Logarithms(cells, floor));
  }
  return pyramid;
}

}  // namespace lightcal
