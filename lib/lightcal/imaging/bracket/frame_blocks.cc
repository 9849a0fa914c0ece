// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/frame_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lightcal/core/statistics.h"
#include "lightcal/imaging/bracket/cubic_weights.h"

namespace lightcal {
namespace {

constexpr int kBlocksAcross = 750;
constexpr int kLeastBlock = 4;  // pixels
constexpr double kSigmas = 6.0;
constexpr double kLeastDifference = 0.02;
constexpr double kRatioSd = 0.003;  // of exposures, and of what blocks add to noise
constexpr double kLeastBlockShare = 1e-3;
constexpr int kLeastBlocks = 4;
constexpr double kExplained = 0.5;
constexpr int kSearch = 8;   // blocks of the small picture, each way
constexpr int kSmaller = 4;  // blocks of a block of the small picture

int BlockSize(const SignalFrame& frame) {
  const int period = frame.row_period;
  const int size = std::max(kLeastBlock, (frame.width + kBlocksAcross - 1) / kBlocksAcross);
  return (size + period - 1) / period * period;
}

// The picture of a frame moved by (dx, dy) blocks; cubic in between, as straight lines would cut
// the corners of textures by more than frames may differ.
std::vector<float> Shifted(const Blocks& a, double dx, double dy) {
  std::vector<float> out(a.mean.size(), std::numeric_limits<float>::quiet_NaN());
  const int fx = static_cast<int>(std::floor(dx)), fy = static_cast<int>(std::floor(dy));
  const auto across = CubicWeightsAt(static_cast<float>(dx - fx));
  const auto down = CubicWeightsAt(static_cast<float>(dy - fy));
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const int sx = x + fx, sy = y + fy;
      if (sx < 1 || sy < 1 || sx + 2 >= a.width || sy + 2 >= a.height) continue;
      float sum = 0.0F;
      for (int j = 0; j < 4; ++j) {
        const float* row = &a.mean[a.At(sx - 1, sy - 1 + j)];
        float line = 0.0F;
        for (int i = 0; i < 4; ++i) line += across[static_cast<std::size_t>(i)] * row[i];
        sum += down[static_cast<std::size_t>(j)] * line;
      }
      out[a.At(x, y)] = sum;
    }
  }
  return out;
}

struct Shift {
  double dx = 0.0, dy = 0.0;  // blocks
};

Blocks Smaller(const Blocks& blocks) {
  Blocks out;
  out.width = blocks.width / kSmaller;
  out.height = blocks.height / kSmaller;
  out.size = blocks.size * kSmaller;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      float mean = 0.0F, variance = 0.0F;
      for (int j = 0; j < kSmaller; ++j) {
        for (int i = 0; i < kSmaller; ++i) {
          const std::size_t at = blocks.At(x * kSmaller + i, y * kSmaller + j);
          mean += blocks.mean[at];
          variance += blocks.variance[at];
        }
      }
      out.mean.push_back(mean / (kSmaller * kSmaller));
      out.variance.push_back(variance / (kSmaller * kSmaller * kSmaller * kSmaller));
    }
  }
  return out;
}

// Whole blocks by which a must move to look most like b: least mean |ln ratio|.
Shift SearchShift(const Blocks& a, const Blocks& b) {
  Shift best;
  double least = std::numeric_limits<double>::infinity();
  for (int dy = -kSearch; dy <= kSearch; ++dy) {
    for (int dx = -kSearch; dx <= kSearch; ++dx) {
      double sum = 0.0, count = 0.0;
      for (int y = std::max(0, -dy); y < std::min(a.height, a.height - dy); ++y) {
        for (int x = std::max(0, -dx); x < std::min(a.width, a.width - dx); ++x) {
          const std::size_t i = a.At(x + dx, y + dy), j = b.At(x, y);
          if (!a.Usable(i) || !b.Usable(j)) continue;
          sum += std::abs(double{a.mean[i]} - b.mean[j]) / (double{a.mean[i]} + b.mean[j]);
          count += 1.0;
        }
      }
      if (count < 0.25 * static_cast<double>(a.mean.size())) continue;
      // A nearer shift wins a draw.
      const double score = sum / count * (1.0 + 1e-6 * (dx * dx + dy * dy));
      if (score < least) {
        least = score;
        best = {static_cast<double>(dx), static_cast<double>(dy)};
      }
    }
  }
  return best;
}

// Adds to the shift what the slopes of the moved picture ask for (Lucas and Kanade, 1981); the
// standard deviation of the less certain direction, in blocks.
double Refine(const Blocks& a, const Blocks& b, Shift& shift) {
  double sd = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < 6; ++pass) {
    const std::vector<float> moved = Shifted(a, shift.dx, shift.dy);
    double xx = 0.0, xy = 0.0, yy = 0.0, xd = 0.0, yd = 0.0, dd = 0.0, count = 0.0;
    for (int y = 1; y + 1 < a.height; ++y) {
      for (int x = 1; x + 1 < a.width; ++x) {
        const std::size_t i = a.At(x, y);
        const double gx = 0.5 * (double{moved[a.At(x + 1, y)]} - moved[a.At(x - 1, y)]);
        const double gy = 0.5 * (double{moved[a.At(x, y + 1)]} - moved[a.At(x, y - 1)]);
        const double level = moved[i];
        if (!b.Usable(i) || !(level > 0.0) || !std::isfinite(gx + gy)) continue;
        // Relative, and bounded: edges of ten stops must not outvote the rest.
        const double weight = 1.0 / (level * level + gx * gx + gy * gy);
        const double d = double{b.mean[i]} - level;
        if (std::abs(d) > level) continue;
        xx += weight * gx * gx;
        xy += weight * gx * gy;
        yy += weight * gy * gy;
        xd += weight * gx * d;
        yd += weight * gy * d;
        dd += weight * d * d;
        count += 1.0;
      }
    }
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > 1e-9 * (xx + yy) * (xx + yy))) break;
    // The smaller eigenvalue of the normal equations.
    const double least = 0.5 * (xx + yy - std::hypot(xx - yy, 2.0 * xy));
    sd = std::sqrt(dd / count / least);
    shift.dx += std::clamp((xd * yy - yd * xy) / determinant, -1.0, 1.0);
    shift.dy += std::clamp((yd * xx - xd * xy) / determinant, -1.0, 1.0);
  }
  return sd;
}

// b brought to the level that `expected` shows: exposures measured on pictures that moved are
// rough.
Blocks AtLevelOf(std::span<const float> expected, const Blocks& b) {
  std::vector<float> ratios;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (b.Usable(i) && expected[i] > 0.0F) ratios.push_back(b.mean[i] / expected[i]);
  }
  Blocks level = b;
  if (ratios.empty()) return level;
  const float middle = UpperMedian(ratios);
  for (float& mean : level.mean) mean /= middle;
  for (float& variance : level.variance) variance /= middle * middle;
  return level;
}

}  // namespace

Blocks BlocksOf(const BracketMerger& merger, std::size_t k) {
  const SignalFrame& frame = merger.frames()[k];
  Blocks blocks;
  blocks.size = BlockSize(frame);
  blocks.width = frame.width / blocks.size;
  blocks.height = frame.height / blocks.size;
  const auto count =
      static_cast<std::size_t>(blocks.width) * static_cast<std::size_t>(blocks.height);
  blocks.mean.assign(count, 0.0F);
  blocks.variance.assign(count, 0.0F);
  const auto exposure = static_cast<float>(merger.plan().exposure[k]);
  const NoiseProfile& noise = merger.plan().noise[k];
  const int across = blocks.size * frame.channels;
  const auto samples = static_cast<float>(across * frame.row_period);
  std::vector<float> row(frame.row_samples());
  for (int by = 0; by < blocks.height; ++by) {
    for (int dy = 0; dy < frame.row_period; ++dy) {
      const int y = by * blocks.size + dy;
      ReadSignals(frame, y, 0, row);
      const auto& channels = frame.channel[static_cast<std::size_t>(y % frame.row_period)];
      for (int bx = 0; bx < blocks.width; ++bx) {
        float sum = 0.0F;
        bool clipped = false;
        for (int i = bx * across; i < (bx + 1) * across; ++i) {
          const auto at = static_cast<std::size_t>(i);
          sum += row[at];
          clipped =
              clipped || row[at] > static_cast<float>(merger.plan().usable) *
                                       frame.clip[static_cast<std::size_t>(channels[at % kLanes])];
        }
        float& mean = blocks.mean[blocks.At(bx, by)];
        mean = clipped ? std::numeric_limits<float>::quiet_NaN() : mean + sum;
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const float signal = blocks.mean[i] / samples;
    // The merge does not believe codes as dark as that either: their curve is a guess.
    const auto floor = static_cast<float>(merger.plan().floor);
    const bool seen = floor == 0.0F || signal >= floor;
    blocks.mean[i] = seen ? signal / exposure : std::numeric_limits<float>::quiet_NaN();
    blocks.variance[i] = static_cast<float>(noise.scale * std::max(0.0F, signal) + noise.offset) /
                         (samples * exposure * exposure);
  }
  return blocks;
}

Differences Compare(const Blocks& a, const Blocks& b, std::span<const float> expected) {
  Differences out;
  out.relative.resize(expected.size());
  out.disagrees.assign(expected.size(), false);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (!a.Usable(i) || !b.Usable(i) || !(expected[i] == expected[i])) continue;
    const double level = 0.5 * (double{b.mean[i]} + expected[i]);
    const double difference = double{b.mean[i]} - expected[i];
    const double sd =
        std::sqrt(double{a.variance[i]} + b.variance[i] + kRatioSd * kRatioSd * level * level);
    out.relative[i] = static_cast<float>(difference / level);
    ++out.comparable;
    if (std::abs(difference) > kSigmas * sd && std::abs(difference) > kLeastDifference * level) {
      out.disagrees[i] = true;
      ++out.disagreeing;
    }
  }
  return out;
}

bool Worth(const Differences& d) {
  return d.disagreeing >= kLeastBlocks && d.disagreeing > kLeastBlockShare * d.comparable;
}

double FoundShift::length() const { return std::hypot(dx, dy); }

std::optional<FoundShift> FindShift(const Blocks& a, const Blocks& b, const Differences& still,
                                    double least_pixels) {
  const Blocks level = AtLevelOf(a.mean, b);
  std::vector<Shift> starts = {Shift{}};
  if (a.width >= 8 * kSmaller && a.height >= 8 * kSmaller) {
    const Shift coarse = SearchShift(Smaller(a), Smaller(level));
    starts.push_back({coarse.dx * kSmaller, coarse.dy * kSmaller});
  }
  starts.push_back(SearchShift(a, level));
  for (Shift shift : starts) {
    Blocks seen = AtLevelOf(Shifted(a, shift.dx, shift.dy), b);
    static_cast<void>(Refine(a, seen, shift));
    seen = AtLevelOf(Shifted(a, shift.dx, shift.dy), b);
    const double sd = Refine(a, seen, shift);
    FoundShift found{shift.dx * a.size, shift.dy * a.size, sd * a.size,
                     Compare(a, seen, Shifted(a, shift.dx, shift.dy))};
    const bool explains = found.left.share() <= (1.0 - kExplained) * still.share() &&
                          2 * found.left.comparable >= still.comparable;
    if (explains && found.length() >= least_pixels) return found;
  }
  return std::nullopt;
}

}  // namespace lightcal
