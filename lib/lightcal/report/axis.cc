// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/axis.h"

#include <array>
#include <cmath>
#include <span>

namespace lightcal::report {
namespace {

constexpr double kLogTicksFromFactor = 5.0;
constexpr double kTolerance = 1e-9;

// value * 10^exponent as the nearest double to the decimal number.
double Decimal(double mantissa, int exponent) {
  const double power = std::pow(10.0, std::abs(exponent));
  return exponent < 0 ? mantissa / power : mantissa * power;
}

bool WideEnough(const Axis& axis, const std::vector<double>& ticks, double min_gap_px) {
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    if (std::abs(axis.At(ticks[i]) - axis.At(ticks[i - 1])) < min_gap_px) return false;
  }
  return true;
}

std::vector<double> Multiples(const Axis& axis, double mantissa, int exponent) {
  const double step = Decimal(mantissa, exponent);
  std::vector<double> ticks;
  const double first = std::ceil(axis.low / step - kTolerance);
  const double last = std::floor(axis.high / step + kTolerance);
  for (double k = first; k <= last; k += 1.0) ticks.push_back(Decimal(k * mantissa, exponent));
  return ticks;
}

std::vector<double> LinearTicks(const Axis& axis, double min_gap_px) {
  constexpr std::array<double, 3> kMantissas = {1.0, 2.0, 5.0};
  const double span = axis.high - axis.low;
  // From far too many ticks up: the first step that leaves the gap.
  const int start = static_cast<int>(std::floor(std::log10(span))) - 2;
  for (int exponent = start; exponent <= start + 4; ++exponent) {
    for (const double mantissa : kMantissas) {
      const auto ticks = Multiples(axis, mantissa, exponent);
      if (WideEnough(axis, ticks, min_gap_px)) return ticks;
    }
  }
  return {};
}

std::vector<double> Decades(const Axis& axis, std::span<const double> mantissas) {
  std::vector<double> ticks;
  const int first = static_cast<int>(std::floor(std::log10(axis.low)));
  const int last = static_cast<int>(std::ceil(std::log10(axis.high)));
  for (int exponent = first; exponent <= last; ++exponent) {
    for (const double mantissa : mantissas) {
      const double value = Decimal(mantissa, exponent);
      if (axis.Holds(value)) ticks.push_back(value);
    }
  }
  return ticks;
}

std::vector<double> LogTicks(const Axis& axis, double min_gap_px) {
  static constexpr std::array<double, 9> kAll = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  static constexpr std::array<double, 5> kFive = {1, 2, 3, 5, 7};
  static constexpr std::array<double, 3> kThree = {1, 2, 5};
  static constexpr std::array<double, 2> kTwo = {1, 3};
  static constexpr std::array<double, 1> kOne = {1};
  const std::array<std::span<const double>, 5> sets = {kAll, kFive, kThree, kTwo, kOne};
  for (const auto& mantissas : sets) {
    auto ticks = Decades(axis, mantissas);
    if (WideEnough(axis, ticks, min_gap_px)) return ticks;
  }
  std::vector<double> sparse;
  for (const double tick : Decades(axis, kOne)) {
    if (sparse.empty() || std::abs(axis.At(tick) - axis.At(sparse.back())) >= min_gap_px) {
      sparse.push_back(tick);
    }
  }
  return sparse;
}

}  // namespace

double Axis::At(double value) const {
  const double share = scale == AxisScale::kLog ? std::log(value / low) / std::log(high / low)
                                                : (value - low) / (high - low);
  return from_px + share * (to_px - from_px);
}

std::vector<double> TicksOf(const Axis& axis, double min_gap_px) {
  if (axis.scale == AxisScale::kLinear || axis.high / axis.low < kLogTicksFromFactor) {
    return LinearTicks(axis, min_gap_px);
  }
  return LogTicks(axis, min_gap_px);
}

}  // namespace lightcal::report
