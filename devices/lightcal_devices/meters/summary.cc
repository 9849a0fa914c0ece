// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/statistics.h"

namespace lightcal::devices {
namespace {

constexpr double kDriftStandardErrors = 3.0;
constexpr double kDriftRelative = 0.005;
constexpr std::size_t kFewestForDrift = 4;  // two degrees of freedom of the residual
constexpr double kFlickerSpread = 0.02;
constexpr std::size_t kFewestForFlicker = 5;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The least-squares line through equally spaced values.
struct Trend {
  double change = 0.0;          // from first to last
  double standard_error = 0.0;  // of the change; 0 with fewer than three values
};

Trend TrendOf(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double v : values) mean += v / n;
  const double middle = (n - 1.0) / 2.0;
  double sxx = 0.0;
  double sxy = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i) - middle;
    sxx += x * x;
    sxy += x * (values[i] - mean);
  }
  const double slope = sxy / sxx;
  double rest = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double r = values[i] - mean - slope * (static_cast<double>(i) - middle);
    rest += r * r;
  }
  const double slope_error = values.size() > 2 ? std::sqrt(rest / (n - 2.0) / sxx) : 0.0;
  return {slope * (n - 1.0), slope_error * (n - 1.0)};
}

// First to last, when it is more than its noise explains.
std::optional<double> Drift(std::span<const double> values, double typical) {
  if (values.size() < kFewestForDrift) return std::nullopt;
  const Trend trend = TrendOf(values);
  const bool shown = std::abs(trend.change) > kDriftStandardErrors * trend.standard_error &&
                     std::abs(trend.change) > kDriftRelative * std::abs(typical);
  return shown ? std::optional(trend.change) : std::nullopt;
}

// Its place among the others: what lies beyond the meter's range lies beyond every number.
double Rank(const Reading& reading) {
  if (reading.over_range) return kInfinity;
  if (reading.under_range) return -kInfinity;
  return reading.illuminance->value();
}

void AddWarnings(const Warnings& more, Warnings& kept) {
  for (const Warning& warning : more) {
    const bool known =
        std::ranges::any_of(kept, [&](const Warning& k) { return k.code == warning.code; });
    if (!known) kept.push_back(warning);
  }
}

// 1 sigma of one measurement from how far all are from their median. Light that jumps back and
// forth leaves most of them at one value and their middle deviation at nothing; one stray in five,
// as any meter has, is what the median is for.
double SpreadOf(std::vector<double> deviations, double median) {
  constexpr double kSdPerMeanDeviation = 1.2533;  // sqrt(pi/2), of a normal variable
  constexpr double kLeastShare = 0.25;
  const auto count = static_cast<double>(deviations.size());
  const double mean = std::accumulate(deviations.begin(), deviations.end(), 0.0) / count;
  const auto away = static_cast<double>(std::ranges::count_if(
      deviations, [&](double deviation) { return deviation > kFlickerSpread * median; }));
  const double middle = kSdPerMad * Median(deviations);
  const double jumps = kSdPerMeanDeviation * mean;
  const bool jumping = away >= kLeastShare * count && std::isfinite(mean) && 2.0 * middle < jumps;
  return (jumping ? jumps : middle) / median;
}

// What a series says about its lamp beyond the median.
void AddSeriesWarnings(const std::vector<double>& values, const Summary& summary,
                       Warnings& warnings) {
  const Reading& kept = summary.kept.reading;
  if (!std::ranges::all_of(values, [](double v) { return std::isfinite(v); })) return;
  const double median = kept.illuminance->value();
  if (const auto drift = Drift(values, median)) {
    warnings.push_back(
        {"drift", kept.device,
         "the readings drift by " + RoundedText(100.0 * *drift / median, 2) +
             " % from first to last; let the lamp warm up ({meter.settle}) and measure "
             "again"});
  } else if (values.size() >= kFewestForFlicker && summary.spread_relative > kFlickerSpread) {
    warnings.push_back(
        {"flicker", kept.device,
         "the readings scatter by " + PercentText(summary.spread_relative) +
             " (1 sigma) without a trend: the lamp flickers or is dimmed by "
             "pulses, or something moves in the beam; take more readings ({meter.count} 25), "
             "or a longer exposure where the meter has one"});
  }
}

}  // namespace

std::optional<Summary> Summarise(std::span<const MeterReading> measurements) {
  std::vector<double> values;
  for (const MeterReading& m : measurements) {
    if (!m.reading.illuminance) return std::nullopt;
    values.push_back(Rank(m.reading));
  }
  if (values.empty()) return std::nullopt;
  std::vector<double> ranked = values;
  const double median = Median(ranked);
  // Between two that are beyond the same end there is no distance.
  const auto distance = [&](double v) { return v == median ? 0.0 : std::abs(v - median); };
  const auto nearest = std::ranges::min_element(values, {}, distance) - values.begin();

  Summary summary{measurements[static_cast<std::size_t>(nearest)], static_cast<int>(values.size()),
                  0.0};
  Reading& reading = summary.kept.reading;
  if (std::isfinite(median)) reading.illuminance = Lux(median);
  if (std::isfinite(median) && median > 0.0) {
    std::vector<double> deviations;
    deviations.reserve(values.size());
    for (const double v : values) deviations.push_back(distance(v));
    summary.spread_relative = SpreadOf(deviations, median);
    const double sigma = std::max(reading.sigma_relative.value_or(0.0), summary.spread_relative);
    if (sigma > 0.0) reading.sigma_relative = sigma;
  }
  for (const MeterReading& m : measurements) AddWarnings(m.warnings, summary.kept.warnings);
  AddSeriesWarnings(values, summary, summary.kept.warnings);
  return summary;
}

bool HasSettled(std::span<const double> illuminances_lx, double tolerance_relative) {
  if (illuminances_lx.size() < kSettleWindow) return false;
  const auto window = illuminances_lx.last(kSettleWindow);
  double mean = 0.0;
  for (const double v : window) mean += v / static_cast<double>(kSettleWindow);
  return std::abs(TrendOf(window).change) <= tolerance_relative * std::abs(mean);
}

}  // namespace lightcal::devices
