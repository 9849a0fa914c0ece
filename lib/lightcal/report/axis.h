// SPDX-License-Identifier: Apache-2.0
// One axis of a figure: where a value lies on the page, and which values to mark.
#pragma once

#include <cstdint>
#include <vector>

namespace lightcal::report {

enum class AxisScale : std::uint8_t { kLinear, kLog };

// Maps low..high to from_px..to_px. Log axes hold for values > 0; low < high.
struct Axis {
  AxisScale scale = AxisScale::kLinear;
  double low = 0.0, high = 1.0;
  double from_px = 0.0, to_px = 1.0;

  // The page coordinate of a value, not clamped.
  [[nodiscard]] double At(double value) const;
  [[nodiscard]] bool Holds(double value) const { return value >= low && value <= high; }
};

// Round values inside the axis, ascending, no two closer than min_gap_px: multiples of 1, 2 or 5
// times a power of ten; on a log axis over a factor of 5 the mantissas 1-9, 1 2 3 5 7, 1 2 5, 1 3,
// or 1, as densely as the gap allows.
[[nodiscard]] std::vector<double> TicksOf(const Axis& axis, double min_gap_px);

}  // namespace lightcal::report
