// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/light_changes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lightcal/core/statistics.h"
#include "lightcal/imaging/bracket/frame_blocks.h"

namespace lightcal {
namespace {

constexpr std::size_t kRegionsAcross = 8, kRegionsDown = 16;
constexpr double kRegionFrom = 0.02, kRegionTo = 0.8;  // of the clip: the longer frame's signal
constexpr double kShorterFrom = 0.02;  // the shorter one's: black levels matter below
constexpr double kLeastRegionSamples = 64.0;
constexpr std::size_t kLeastRegions = 8;
constexpr double kWorstRegionSd = 0.01;
constexpr double kOutside = 0.1;  // of what is seen, on each side of the range
constexpr double kLeastWidth = 0.01;
constexpr double kRegionSigmas = 6.0;
constexpr double kExplainedByShift = 0.5;
constexpr std::size_t kLeastRegionBlocks = 4;
constexpr int kTurnsOfFlicker = 3;
constexpr double kLeastRegionShift = 0.02;  // pixels

struct LitRegion {
  double count = 0.0, a = 0.0, b = 0.0, aa = 0.0, ab = 0.0, bb = 0.0;
};

struct SeenRatio {
  double ln_ratio = 0.0, sd = 0.0, weight = 0.0;
};

std::optional<RatioRange> RangeOfSeen(std::vector<SeenRatio> seen) {
  if (seen.size() < kLeastRegions) return std::nullopt;
  std::ranges::sort(seen, {}, &SeenRatio::ln_ratio);
  double total = 0.0;
  for (const SeenRatio& region : seen) total += region.weight;
  const auto at = [&](double share) {
    double below = 0.0;
    for (const SeenRatio& region : seen) {
      below += region.weight;
      if (below >= share * total) return region;
    }
    return seen.back();
  };
  const SeenRatio low = at(kOutside), high = at(1.0 - kOutside);
  const double noise = kRegionSigmas * std::hypot(low.sd, high.sd);
  if (high.ln_ratio - low.ln_ratio < std::max(kLeastWidth, noise)) return std::nullopt;
  return RatioRange{low.ln_ratio, high.ln_ratio};
}

std::optional<SeenRatio> SeenIn(const LitRegion& region) {
  if (region.count < kLeastRegionSamples || !(region.a > 0.0) || !(region.b > 0.0)) {
    return std::nullopt;
  }
  const double r = region.b / region.a;
  const double residuals = region.bb - 2.0 * r * region.ab + r * r * region.aa;
  const double sd = std::sqrt(std::max(0.0, residuals)) / region.b;
  if (!(sd < kWorstRegionSd)) return std::nullopt;
  return SeenRatio{std::log(r), sd, region.count};
}

using LitRegions = std::array<LitRegion, kRegionsAcross * kRegionsDown>;

std::vector<SeenRatio> SeenOf(const LitRegions& regions) {
  std::vector<SeenRatio> seen;
  for (const LitRegion& region : regions) {
    if (const auto ratio = SeenIn(region)) seen.push_back(*ratio);
  }
  return seen;
}

// How often the ratio turns, from the top of a column of regions to its foot, by `step` and more.
int TurnsOf(const LitRegions& regions, std::size_t column, double step) {
  std::optional<double> extreme;  // the last one
  int direction = 0, turns = 0;
  for (std::size_t row = 0; row < kRegionsDown; ++row) {
    const auto ratio = SeenIn(regions[row * kRegionsAcross + column]);
    if (!ratio) continue;
    const double value = ratio->ln_ratio;
    if (!extreme || direction * (value - *extreme) > 0.0) extreme = value;
    if (std::abs(value - *extreme) < step) continue;
    turns += direction == 0 ? 0 : 1;
    direction = value > *extreme ? 1 : -1;
    extreme = value;
  }
  return turns;
}

// A pulsed lamp under a rolling shutter: the ratio goes up and down again and again from row to
// row. A light that changed in part of the picture goes there once.
bool Flickers(const LitRegions& regions, const RatioRange& range) {
  for (std::size_t column = 0; column < kRegionsAcross; ++column) {
    if (TurnsOf(regions, column, 0.5 * range.width()) >= kTurnsOfFlicker) return true;
  }
  return false;
}

// How far apart the middles of regions lie, 0 within the least that counts, over blocks that `also`
// compares: a shift must not explain by what it pushes out of the picture.
double WidthOfRegions(const Differences& differences, const Differences& also,
                      const Blocks& blocks) {
  std::array<std::vector<float>, kRegionsAcross * kRegionsDown> values;
  for (int y = 0; y < blocks.height; ++y) {
    for (int x = 0; x < blocks.width; ++x) {
      const auto& relative = differences.relative[blocks.At(x, y)];
      if (!relative || !also.relative[blocks.At(x, y)]) continue;
      const std::size_t row =
          static_cast<std::size_t>(y) * kRegionsDown / static_cast<std::size_t>(blocks.height);
      const std::size_t column =
          static_cast<std::size_t>(x) * kRegionsAcross / static_cast<std::size_t>(blocks.width);
      values[row * kRegionsAcross + column].push_back(*relative);
    }
  }
  std::vector<SeenRatio> seen;
  for (auto& region : values) {
    if (region.size() < kLeastRegionBlocks) continue;
    const auto count = static_cast<double>(region.size());
    seen.push_back({double{UpperMedian(region)}, 0.0, count});
  }
  const auto range = RangeOfSeen(std::move(seen));
  return range ? range->width() : 0.0;
}

}  // namespace

std::optional<RatioRange> DisagreeingRegions(const SampledSignals& signals, std::size_t a,
                                             std::size_t b, std::span<const float> clip,
                                             double ratio) {
  const std::size_t width = signals.row_samples;
  if (width == 0 || signals.clip.size() < kRegionsDown * width) return std::nullopt;
  const std::size_t rows = signals.clip.size() / width;
  LitRegions regions{};
  const double share = 1.0 / (1.0 + ratio);
  const double longer = std::max(ratio, 1.0), shorter = std::min(ratio, 1.0);
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t column = 0; column < kRegionsAcross; ++column) {
      LitRegion& region = regions[y * kRegionsDown / rows * kRegionsAcross + column];
      const std::size_t first = y * width + column * width / kRegionsAcross;
      const std::size_t end = y * width + (column + 1) * width / kRegionsAcross;
      for (std::size_t i = first; i < end; ++i) {
        const double ya = signals.frames[a][i], yb = signals.frames[b][i], full = clip[i];
        const double x = (ya + yb) * share;
        if (x * longer < kRegionFrom * full || x * longer > kRegionTo * full) continue;
        if (x * shorter < kShorterFrom * full || std::max(ya, yb) > kClippedFrom * full) continue;
        region.count += 1.0;
        region.a += ya;
        region.b += yb;
        region.aa += ya * ya;
        region.ab += ya * yb;
        region.bb += yb * yb;
      }
    }
  }
  const auto range = RangeOfSeen(SeenOf(regions));
  return range && !Flickers(regions, *range) ? range : std::nullopt;
}

bool IsShift(const SignalFrame& a, const SignalFrame& b, double ratio) {
  const bool ascending = ratio >= 1.0;
  const std::vector<SignalFrame> frames = {ascending ? a : b, ascending ? b : a};
  MergePlan plan;
  plan.exposure = {1.0, std::max(ratio, 1.0 / ratio)};
  plan.noise.assign(2, kMiddlingNoise);
  const auto merger = BracketMerger::Make(frames, plan);
  if (!merger) return false;
  const Blocks before = BlocksOf(*merger, 0), after = BlocksOf(*merger, 1);
  const Differences still = Compare(before, after, before.mean);
  const auto found = FindShift(before, after, still, kLeastRegionShift);
  return found && WidthOfRegions(found->left, still, before) <
                      kExplainedByShift * WidthOfRegions(still, found->left, before);
}

}  // namespace lightcal
