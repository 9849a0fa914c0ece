// SPDX-License-Identifier: Apache-2.0
// What an architect's table asks of a plane: mean, least, uniformity.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal::app {

struct MapSummary;

struct GridTarget {
  std::optional<double> mean_lx, least_lx;
  std::optional<double> uniformity;  // U0 = least/mean (EN 12464-1)
};

// "500lx", "500lx,U0=0.6,min=300lx". Wrong usage: anything else.
[[nodiscard]] Result<GridTarget> ParseGridTarget(const std::string& text);

// One demand and what was found; `open` where the 95 % interval holds both answers.
struct GridVerdict {
  std::string_view what;  // "mean_lx", "min_lx", "U0"
  double asked = 0.0, found = 0.0;
  enum class Word { kMet, kMissed, kOpen } word = Word::kMet;
};
// u0's interval: errors common to all points cancel in it, so it has none here.
[[nodiscard]] std::vector<GridVerdict> JudgeGrid(const GridTarget& target, const MapSummary& found);
[[nodiscard]] std::string_view WordOf(GridVerdict::Word word);

}  // namespace lightcal::app
