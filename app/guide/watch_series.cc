// SPDX-License-Identifier: Apache-2.0
#include "guide/watch_series.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lightcal::app {
namespace {

constexpr double kSecondsPerMinute = 60.0;
constexpr double kLeastForDrift = 10.0;       // seconds; a shorter look tells no minute
constexpr std::size_t kFewestForScatter = 3;  // one degree of freedom beside the trend

// A trend is one where it is more than three of its own standard errors; else flicker that is seen
// for a few periods only would pass for one.
constexpr double kTrendStandardErrors = 3.0;

// value = mean + slope (x - middle), least squares; slope 0 where the values show none.
struct TrendLine {
  double middle = 0.0, mean = 0.0, slope = 0.0;
  [[nodiscard]] double At(double x) const { return mean + slope * (x - middle); }
};

TrendLine LineThrough(const std::vector<double>& x, const std::vector<double>& y) {
  TrendLine line;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    line.middle += x[i] / n;
    line.mean += y[i] / n;
  }
  double sxx = 0.0;
  double sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sxx += (x[i] - line.middle) * (x[i] - line.middle);
    sxy += (x[i] - line.middle) * (y[i] - line.mean);
  }
  if (!(sxx > 0.0) || x.size() < kFewestForScatter) return line;
  line.slope = sxy / sxx;
  double squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    squares += (y[i] - line.At(x[i])) * (y[i] - line.At(x[i]));
  }
  const double slope_error = std::sqrt(squares / (n - 2.0) / sxx);
  if (std::abs(line.slope) <= kTrendStandardErrors * slope_error) line.slope = 0.0;
  return line;
}

}  // namespace

void WatchSeries::Add(const Reading& reading, std::optional<double> seconds) {
  readings_.push_back(reading);
  seconds_.push_back(seconds);
  ++count_;
  if (readings_.size() <= kWindow) return;
  readings_.pop_front();
  seconds_.pop_front();
}

Steadiness WatchSeries::Steady() const {
  std::vector<double> lux;
  std::vector<double> x;  // seconds, or the number of the reading
  const bool timed =
      std::ranges::all_of(seconds_, [](const auto& seconds) { return seconds.has_value(); });
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    lux.push_back(readings_[i].illuminance->value());
    x.push_back(timed ? *seconds_[i] : static_cast<double>(i));
  }
  Steadiness steady;
  const TrendLine line = LineThrough(x, lux);
  steady.mean_lx = line.mean;
  steady.least_lx = *std::ranges::min_element(lux);
  steady.most_lx = *std::ranges::max_element(lux);
  const double lasted = x.back() - x.front();
  if (timed && lasted > 0.0) steady.rate_hz = static_cast<double>(lux.size() - 1) / lasted;
  if (lux.size() < kFewestForScatter || !(line.mean > 0.0)) return steady;
  double squares = 0.0;
  double least = line.mean;
  double most = line.mean;
  for (std::size_t i = 0; i < lux.size(); ++i) {
    const double rest = lux[i] - line.At(x[i]);
    squares += rest * rest;
    least = std::min(least, line.mean + rest);
    most = std::max(most, line.mean + rest);
  }
  const auto freedom = static_cast<double>(lux.size() - 2);
  steady.scatter_relative = std::sqrt(squares / freedom) / line.mean;
  steady.modulation = (most - least) / (most + least);
  if (timed && lasted >= kLeastForDrift && line.slope != 0.0) {
    steady.drift_per_minute_relative = kSecondsPerMinute * line.slope / line.mean;
  }
  return steady;
}

}  // namespace lightcal::app
