// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/frame_agreement.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/parallel.h"
#include "lightcal/imaging/bracket/frame_blocks.h"

namespace lightcal {
namespace {

constexpr double kBandRms = 0.01;  // of a row's mean difference
constexpr double kBandOverColumns = 3.0;
constexpr std::size_t kAtOnce = 4;  // frames in memory as blocks

Warning Misaligned(const FoundShift& found, const std::string& name, const std::string& other) {
  return {"misaligned", name,
          "the camera moved by " + RoundedText(found.length(), 2) + " pixels between " + other +
              " and this frame; edges are wrong and wide in sigma. Use a tripod, or {merge.align} "
              "auto"};
}

// Mean relative difference along rows (or columns).
double ProfileRms(const Differences& d, int width, int height, bool rows) {
  double squares = 0.0;
  int lines = 0;
  const int outer = rows ? height : width, inner = rows ? width : height;
  for (int i = 0; i < outer; ++i) {
    double sum = 0.0;
    int count = 0;
    for (int j = 0; j < inner; ++j) {
      const int x = rows ? j : i, y = rows ? i : j;
      const auto& value = d.relative[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                     static_cast<std::size_t>(x)];
      if (!value) continue;
      sum += *value;
      ++count;
    }
    if (count < 8) continue;
    squares += (sum / count) * (sum / count);
    ++lines;
  }
  return lines == 0 ? 0.0 : std::sqrt(squares / lines);
}

std::optional<Warning> Flicker(const Differences& d, const Blocks& blocks, const std::string& name,
                               const std::string& other) {
  const double rows = ProfileRms(d, blocks.width, blocks.height, true);
  const double columns = ProfileRms(d, blocks.width, blocks.height, false);
  if (rows < kBandRms || rows < kBandOverColumns * columns) return std::nullopt;
  return Warning{"flicker", name,
                 "its rows differ from those of " + other + " by " + PercentText(rows) +
                     " rms: a pulsed lamp under a rolling shutter. Use a shutter time that is a "
                     "whole number of mains half periods (1/100 or 1/120 s), or an ND filter"};
}

Warning SceneMoved(const Differences& d, const Blocks& blocks, const std::string& name,
                   const std::string& other) {
  int left = blocks.width, top = blocks.height, right = 0, bottom = 0;
  for (int y = 0; y < blocks.height; ++y) {
    for (int x = 0; x < blocks.width; ++x) {
      if (!d.disagrees[blocks.At(x, y)]) continue;
      left = std::min(left, x);
      right = std::max(right, x + 1);
      top = std::min(top, y);
      bottom = std::max(bottom, y + 1);
    }
  }
  const auto pixels = [&](int block_count) { return std::to_string(block_count * blocks.size); };
  return {"moved_content", name,
          RoundedText(100.0 * d.disagreeing / d.comparable, 2) + " % of the picture differs from " +
              other + ", within x,y,w,h = " + pixels(left) + "," + pixels(top) + "," +
              pixels(right - left) + "," + pixels(bottom - top) +
              ": something moved or changed its brightness; sigma is wide there"};
}

// What is wrong between a frame and the one before it.
std::optional<Warning> DifferenceOf(const Blocks& before, const Blocks& blocks,
                                    const std::string& name, const std::string& other,
                                    double tolerated_pixels) {
  const Differences still = Compare(before, blocks, before.mean);
  if (!Worth(still)) return std::nullopt;
  if (const auto found = FindShift(before, blocks, still, kLeastShiftPixels)) {
    if (found->length() <= tolerated_pixels) return std::nullopt;
    return Misaligned(*found, name, other);
  }
  const auto flicker = Flicker(still, blocks, name, other);
  return flicker ? *flicker : SceneMoved(still, blocks, name, other);
}

}  // namespace

Warnings CompareFrames(const BracketMerger& merger, double tolerated_pixels,
                       const FrameDone& done_with) {
  const std::size_t n = merger.frames().size();
  Warnings warnings;
  Blocks last;
  for (std::size_t first = 0; first < n; first += kAtOnce) {
    std::vector<Blocks> blocks(std::min(kAtOnce, n - first));
    ParallelFor(static_cast<int>(blocks.size()), [&](int i) {
      const std::size_t k = first + static_cast<std::size_t>(i);
      blocks[k - first] = BlocksOf(merger, k);
      if (done_with) done_with(k);
    });
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const std::size_t k = first + i;
      if (k == 0) continue;
      const Blocks& before = i == 0 ? last : blocks[i - 1];
      auto warning = DifferenceOf(before, blocks[i], merger.frames()[k].name,
                                  merger.frames()[k - 1].name, tolerated_pixels);
      if (warning) warnings.push_back(*std::move(warning));
    }
    last = std::move(blocks.back());
  }
  return warnings;
}

}  // namespace lightcal
