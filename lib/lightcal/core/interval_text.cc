// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/interval_text.h"

#include <cmath>
#include <numbers>

#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

// "−20", "+31" of an end over the value.
std::string Arm(double relative) {
  const std::string digits = RoundedText(100.0 * std::abs(relative), 2);
  if (relative == 0.0) return "0";
  return (relative < 0.0 ? "\u2212" : "+") + digits;
}

}  // namespace

std::string RelativeText(const Uncertain& u) {
  if (!(u.u95 > 0.0) || u.value == 0.0) return "";
  if (IsEven(u)) return "± " + PercentText(std::abs(0.5 * (HighEnd(u) - LowEnd(u)) / u.value));
  return Arm(LowEnd(u) / u.value - 1.0) + " … " + Arm(HighEnd(u) / u.value - 1.0) + " %";
}

Uncertain IntervalOfWidths(double u95_relative, double u95_stops) {
  if (!std::isfinite(u95_stops)) return {1.0, u95_relative, 0.0, 2.0 * u95_relative};
  const double over = std::expm1(2.0 * std::numbers::ln2 * u95_stops);  // high / low - 1
  const double low = over > 0.0 ? 2.0 * u95_relative / over : 1.0;
  return {1.0, u95_relative, low, low * (1.0 + over)};
}

Uncertain IntervalOfFactor(double u95_relative) {
  return UncertainFromLog(0.0, std::asinh(u95_relative) / kZ95);
}

std::string PlainInterval(const Uncertain& u, const std::string& unit) {
  std::string text = RoundedText(u.value, 4) + " " + unit;
  if (IsEven(u)) {
    return text + " +- " + PercentText(0.5 * (HighEnd(u) - LowEnd(u)) / u.value) + " (95 %)";
  }
  return text + ", " + RoundedText(LowEnd(u), 3) + " to " + RoundedText(HighEnd(u), 3) + " " +
         unit + " (95 %)";
}

}  // namespace lightcal
