// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/motion_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "lightcal/core/parallel.h"
#include "lightcal/imaging/bracket/sampled.h"

namespace lightcal {
namespace {

constexpr int kCoarsest = 48;  // cells on the longer side
constexpr std::size_t kNoiseLevels = 40;
constexpr double kNoiseLevelLn = 0.35, kLeastNoiseLevel = 1e-6;  // signal
constexpr std::size_t kLeastOfALevel = 60;
constexpr double kLowerQuartile = 0.3186;  // of |normal|
constexpr double kDeepest = 0.1;           // of the mean around, of a cell that counts
constexpr double kLeastClear = 4.0;  // signal over noise of a cell whose logarithm says something

// Signals and variances of cells; a negative variance: clipped.
struct MotionCells {
  int width = 0, height = 0;
  double cell = 1.0;
  std::vector<float> mean, variance;

  [[nodiscard]] std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

// Of one cell, for each channel.
struct ChannelSums {
  std::array<double, 4> sum{}, count{};
  std::array<bool, 4> clipped{};
};

struct MotionCell {
  double mean = 0.0, variance = 0.0;  // negative: clipped
};
struct CellPair {
  MotionCell all, darkest;
};

CellPair CellsOf(const ChannelSums& cell, const NoiseProfile& noise) {
  const auto of = [&](double sum, double count, bool clipped) {
    const double mean = sum / count;
    return MotionCell{mean,
                      clipped ? -1.0 : (noise.scale * std::max(mean, 0.0) + noise.offset) / count};
  };
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
  return {of(sum, count, clipped), of(cell.sum[least], cell.count[least], cell.clipped[least])};
}

struct CellsOfBoth {
  MotionCells all, darkest;
};

CellsOfBoth MotionCellsOf(const SignalFrame& frame, const NoiseProfile& noise, int longest) {
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
  CellsOfBoth both{cells, cells};
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
      const CellPair pair = CellsOf(sums[x], noise);
      const std::size_t at = static_cast<std::size_t>(y) * across + x;
      both.all.mean[at] = static_cast<float>(pair.all.mean);
      both.all.variance[at] = static_cast<float>(pair.all.variance);
      both.darkest.mean[at] = static_cast<float>(pair.darkest.mean);
      both.darkest.variance[at] = static_cast<float>(pair.darkest.variance);
    }
  });
  return both;
}

// The mean of 5 x 5 cells, without those that are clipped. What is chosen or weighted by it does
// not depend on a cell's own noise: cells chosen because their noise lifts them would pull.
std::vector<float> MeansAround(const MotionCells& cells) {
  constexpr int kReach = 2;
  std::vector<float> around(cells.mean.size(), 0.0F);
  ParallelFor(cells.height, [&](int y) {
    for (int x = 0; x < cells.width; ++x) {
      float sum = 0.0F, count = 0.0F;
      for (int v = std::max(0, y - kReach); v <= std::min(cells.height - 1, y + kReach); ++v) {
        for (int u = std::max(0, x - kReach); u <= std::min(cells.width - 1, x + kReach); ++u) {
          const std::size_t at = cells.At(u, v);
          if (cells.variance[at] < 0.0F) continue;
          sum += cells.mean[at];
          count += 1.0F;
        }
      }
      if (count > 0.0F) around[cells.At(x, y)] = sum / count;
    }
  });
  return around;
}

// Where a mean lies among the levels whose noise is told apart.
std::size_t NoiseLevelOf(double mean) {
  const double level = (std::log(mean) - std::log(kLeastNoiseLevel)) / kNoiseLevelLn;
  return static_cast<std::size_t>(std::clamp(level, 0.0, kNoiseLevels - 1.0));
}

// The noise that the cells themselves show: of each level the lower quartile of |second difference|
// (edges are the upper part), whose variance is 1.5 times a cell's.
void RaiseToOwnNoise(std::span<const float> around, MotionCells& cells) {
  std::array<std::vector<float>, kNoiseLevels> differences;
  const auto width = static_cast<std::size_t>(cells.width);
  for (std::size_t at = 1; at + 1 < cells.mean.size(); ++at) {
    const std::size_t x = at % width;
    if (x == 0 || x + 1 == width || !(around[at] > 0.0F)) continue;
    if (cells.variance[at - 1] < 0.0F || cells.variance[at] < 0.0F) continue;
    if (cells.variance[at + 1] < 0.0F) continue;
    differences[NoiseLevelOf(around[at])].push_back(
        std::abs(cells.mean[at] - 0.5F * (cells.mean[at - 1] + cells.mean[at + 1])));
  }
  std::array<double, kNoiseLevels> variance{};
  for (std::size_t level = 0; level < kNoiseLevels; ++level) {
    std::vector<float>& of = differences[level];
    if (of.size() < kLeastOfALevel) continue;
    const auto quarter = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 4);
    std::nth_element(of.begin(), quarter, of.end());
    const double sd = double{*quarter} / kLowerQuartile;
    variance[level] = sd * sd / 1.5;
  }
  for (std::size_t at = 0; at < cells.mean.size(); ++at) {
    if (cells.variance[at] < 0.0F || !(around[at] > 0.0F)) continue;
    cells.variance[at] =
        std::max(cells.variance[at], static_cast<float>(variance[NoiseLevelOf(around[at])]));
  }
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

std::vector<SeenAround> SeenAroundOf(const MotionPicture& picture) {
  std::vector<SeenAround> around(picture.variance.size(), SeenAround{});
  const auto all = [&](int x, int y, int before, int after) {
    if (x < before || y < before || x + after >= picture.width || y + after >= picture.height) {
      return false;
    }
    for (int v = y - before; v <= y + after; ++v) {
      for (int u = x - before; u <= x + after; ++u) {
        if (picture.variance[picture.At(u, v)] < 0.0F) return false;
      }
    }
    return true;
  };
  ParallelFor(picture.height, [&](int y) {
    for (int x = 0; x < picture.width; ++x) {
      SeenAround& seen = around[picture.At(x, y)];
      seen.four = all(x, y, 0, 1);
      seen.eight = seen.four && all(x, y, 1, 1);
      seen.cubic = seen.eight && all(x, y, 1, 2);
    }
  });
  return around;
}

MotionPicture Logarithms(const MotionCells& cells, double floor) {
  MotionPicture picture{cells.width, cells.height, cells.cell, {}, {}, {}, {}};
  picture.ln.resize(cells.mean.size());
  picture.around.resize(cells.mean.size());
  picture.variance.assign(cells.mean.size(), -1.0F);
  const std::vector<float> around = MeansAround(cells);
  for (std::size_t i = 0; i < cells.mean.size(); ++i) {
    const double mean = cells.mean[i], variance = cells.variance[i], level = around[i];
    const bool clear = variance >= 0.0 && level > floor && mean > kDeepest * level &&
                       level * level > kLeastClear * kLeastClear * variance;
    if (!clear) continue;
    picture.ln[i] = static_cast<float>(std::log(mean));
    picture.around[i] = static_cast<float>(std::log(level));
    picture.variance[i] = static_cast<float>(variance / (mean * mean));
  }
  picture.seen_around = SeenAroundOf(picture);
  return picture;
}

}  // namespace

namespace {

MotionPyramid PyramidOf(MotionCells cells, double floor) {
  MotionPyramid pyramid;
  RaiseToOwnNoise(MeansAround(cells), cells);
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

}  // namespace

MotionPyramids MotionPyramidsOf(const SignalFrame& frame, const NoiseProfile& noise, double floor,
                                int longest) {
  CellsOfBoth cells = MotionCellsOf(frame, noise, longest);
  const bool full =
      std::ranges::any_of(frame.clip, [](float clip) { return clip >= kClipUnknownFrom; }) ||
      std::ranges::any_of(cells.all.variance, [](float variance) { return variance < 0.0F; });
  return {PyramidOf(std::move(cells.all), floor), PyramidOf(std::move(cells.darkest), floor), full};
}

}  // namespace lightcal
