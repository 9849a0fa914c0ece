// SPDX-License-Identifier: Apache-2.0
// A value with its 95 % interval, as every JSON answer of lightcal spells it.
#pragma once

#include <optional>

namespace lightcal {

// Half the width of the central 95 % interval of a normal variable, in standard deviations.
inline constexpr double kZ95 = 1.959963984540054;

// value with u95 = half the width of its 95 % interval, in the value's own unit. Where the interval
// is not symmetric (an intensity fitted as ln I), low and high hold its true ends.
struct Uncertain {
  double value = 0.0;
  double u95 = 0.0;
  std::optional<double> low;
  std::optional<double> high;
};

// The ends of the interval.
[[nodiscard]] inline double LowEnd(const Uncertain& u) { return u.low.value_or(u.value - u.u95); }
[[nodiscard]] inline double HighEnd(const Uncertain& u) { return u.high.value_or(u.value + u.u95); }

// Whether "value +- u95" tells it: its arms are alike to a quarter.
[[nodiscard]] inline bool IsEven(const Uncertain& u) {
  constexpr double kAlike = 1.25;
  const double below = u.low ? u.value - *u.low : u.u95;
  const double above = u.high ? *u.high - u.value : u.u95;
  return below <= kAlike * above && above <= kAlike * below;
}

// The value exp(mean_ln) of a variable that is normal in its logarithm:
//   low, high = value exp(-+ kZ95 sd_ln),  u95 = (high - low)/2 = value sinh(kZ95 sd_ln).
[[nodiscard]] Uncertain UncertainFromLog(double mean_ln, double sd_ln);
// An interval of ln value made wider: its ends `factor` times as far away, and in squares
// `relative_sd` (1 sigma) beside. Left alone where it is not one of a positive value.
void WidenInLn(Uncertain& value, double factor, double relative_sd);
// value +- kZ95 sd.
[[nodiscard]] Uncertain UncertainFromNormal(double value, double sd);

}  // namespace lightcal
