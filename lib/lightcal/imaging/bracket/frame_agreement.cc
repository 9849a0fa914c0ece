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
#include "lightcal/core/statistics.h"
#include "lightcal/imaging/bracket/frame_blocks.h"
#include "lightcal/imaging/bracket/moved_shape.h"

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
  std::vector<float> by;
  int left = blocks.width, top = blocks.height, right = 0, bottom = 0;
  for (int y = 0; y < blocks.height; ++y) {
    for (int x = 0; x < blocks.width; ++x) {
      if (!d.disagrees[blocks.At(x, y)]) continue;
      by.push_back(*d.relative[blocks.At(x, y)]);
      left = std::min(left, x);
      right = std::max(right, x + 1);
      top = std::min(top, y);
      bottom = std::max(bottom, y + 1);
    }
  }
  const auto pixels = [&](int block_count) { return std::to_string(block_count * blocks.size); };
  return {"moved_content", name,
          RoundedText(100.0 * d.disagreeing / d.comparable, 2) + " % of the picture differs from " +
              other + ", by " + RoundedText(100.0 * UpperMedian(by), 2) +
              " % in the middle of them, within x,y,w,h = " + pixels(left) + "," + pixels(top) +
              "," + pixels(right - left) + "," + pixels(bottom - top) +
              ": something moved or changed its brightness; sigma is wide there"};
}

struct FoundDifference {
  Warning warning;
  double size = 0.0;  // among those of its kind
};

// What is wrong between a frame and the one before it.
std::optional<FoundDifference> DifferenceOf(const Blocks& before, const Blocks& blocks,
                                            const SignalFrame& frame, const std::string& other,
                                            double tolerated_pixels) {
  const std::string& name = frame.name;
  Differences still = Compare(before, blocks, before.mean);
  if (!Worth(still)) return std::nullopt;
  if (const auto found = FindShift(before, blocks, still, kLeastShiftPixels)) {
    if (found->length() <= tolerated_pixels) return std::nullopt;
    return FoundDifference{Misaligned(*found, name, other), found->length()};
  }
  if (frame.response != nullptr) {
    still = WithShape(still, before);
    if (still.disagreeing == 0) return std::nullopt;
  }
  const auto flicker = Flicker(still, blocks, name, other);
  if (flicker)
    return FoundDifference{*flicker, ProfileRms(still, blocks.width, blocks.height, true)};
  return FoundDifference{SceneMoved(still, blocks, name, other), still.share()};
}

// The worst of each kind, which counts and names the others.
Warnings OneOfEachKind(const std::vector<FoundDifference>& found, std::size_t frames) {
  constexpr std::size_t kMostNames = 3;
  Warnings warnings;
  for (const FoundDifference& first : found) {
    const std::string& code = first.warning.code;
    if (std::ranges::any_of(warnings, [&](const Warning& w) { return w.code == code; })) continue;
    std::vector<const FoundDifference*> kind;
    for (const FoundDifference& other : found) {
      if (other.warning.code == code) kind.push_back(&other);
    }
    std::ranges::stable_sort(kind, [](const auto* a, const auto* b) { return a->size > b->size; });
    Warning worst = kind.front()->warning;
    for (std::size_t i = 1; i < kind.size() && i <= kMostNames; ++i) {
      worst.message += (i == 1 ? ". So do, less, " : ", ") + kind[i]->warning.subject;
    }
    if (kind.size() > kMostNames + 1) {
      worst.message += " and " + std::to_string(kind.size() - kMostNames - 1) + " more";
    }
    if (kind.size() > 1) {
      worst.message +=
          " (" + std::to_string(kind.size()) + " of " + std::to_string(frames) + " frames)";
    }
    warnings.push_back(std::move(worst));
  }
  return warnings;
}

}  // namespace

Warnings CompareFrames(const BracketMerger& merger, double tolerated_pixels,
                       const FrameDone& done_with) {
  const std::size_t n = merger.frames().size();
  std::vector<FoundDifference> found;
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
      auto difference = DifferenceOf(before, blocks[i], merger.frames()[k],
                                     merger.frames()[k - 1].name, tolerated_pixels);
      if (difference) found.push_back(*std::move(difference));
    }
    last = std::move(blocks.back());
  }
  return OneOfEachKind(found, n);
}

}  // namespace lightcal
