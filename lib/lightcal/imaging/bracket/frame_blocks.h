// SPDX-License-Identifier: Apache-2.0
// Frames as means of blocks: small enough to compare whole pictures, and to find how far one moved.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/imaging/bracket/merge_bracket.h"

namespace lightcal {

// Means of a frame's signals over blocks of `size` pixels each way, divided by the exposure.
struct Blocks {
  int width = 0, height = 0, size = 1;
  std::vector<float> mean;                // scene units; NaN inside only: too bright or dark
  std::vector<float> variance;            // of the mean
  static constexpr float kClear = 10.0F;  // signal over noise of a block worth comparing

  [[nodiscard]] std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] bool Usable(std::size_t i) const {
    return mean[i] == mean[i] && mean[i] * mean[i] > kClear * kClear * variance[i] &&
           mean[i] > 0.0F;
  }
};

// Of frame k of the merge, about 750 blocks across: the first rows of every block, one period of
// the pattern.
[[nodiscard]] Blocks BlocksOf(const BracketMerger& merger, std::size_t k);

// Relative differences of two frames' blocks; absent where nothing can be compared.
struct Differences {
  std::vector<std::optional<float>> relative;
  std::vector<bool> disagrees;
  int comparable = 0, disagreeing = 0;

  [[nodiscard]] double share() const {
    return comparable == 0 ? 0.0 : static_cast<double>(disagreeing) / comparable;
  }
};

// b against `expected`, blocks of a as b should show them. They disagree beyond six standard
// deviations and 2 %.
[[nodiscard]] Differences Compare(const Blocks& a, const Blocks& b,
                                  std::span<const float> expected);
// From 0.1 % of the comparable blocks on, and four of them.
[[nodiscard]] bool Worth(const Differences& differences);

// How far the picture moved: what a shows at x + shift, b shows at x.
struct FoundShift {
  double dx = 0.0, dy = 0.0;  // pixels
  double sd = 0.0;            // of the less certain of the two, pixels
  Differences left;           // of the blocks when a is moved so
  [[nodiscard]] double length() const;
};
// The shift, at a level of its own, that explains more than half of what disagrees between two
// pictures, when it is at least `least_pixels` and leaves half of the blocks comparable; sought
// within 32 blocks.
[[nodiscard]] std::optional<FoundShift> FindShift(const Blocks& a, const Blocks& b,
                                                  const Differences& still, double least_pixels);

}  // namespace lightcal
