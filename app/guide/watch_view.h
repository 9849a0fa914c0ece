// SPDX-License-Identifier: Apache-2.0
// A watched meter as a person sees it: a block that is drawn over itself in a terminal, a line a
// reading elsewhere.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "guide/watch_series.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

// One character a value, "▁" the least and "█" the most of them; values that differ by less than
// 0.1 % of the most are one level.
[[nodiscard]] std::string Sparkline(std::span<const double> values);

// "406.96 lx  4995 K  Duv -0.0011"
[[nodiscard]] std::string ReadingText(const Reading& reading);
// What the series says of flicker and drift.
[[nodiscard]] std::string FlickerText(const Steadiness& steady);
// Which flicker a meter of this pace can see; "" where the pace is not known.
[[nodiscard]] std::string PaceText(const Steadiness& steady);
// The block's lines, none wider than `columns`.
[[nodiscard]] std::vector<std::string> WatchBlock(const WatchSeries& series,
                                                  const std::optional<FittedLight>& light,
                                                  std::size_t columns);

// Lines that are drawn over what was drawn before.
class DrawnOver {
 public:
  // Whether stdout is a terminal that can move its cursor.
  [[nodiscard]] static bool Possible();
  [[nodiscard]] static std::size_t Columns();
  void Draw(const std::vector<std::string>& lines);

 private:
  std::size_t drawn_ = 0;
};

}  // namespace lightcal::app
