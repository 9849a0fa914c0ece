// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/summary.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kSigmaPerMad = 1.4826;  // 1/Phi^-1(3/4)
constexpr double kDriftStandardErrors = 3.0;
constexpr double kDriftRelative = 0.005;
constexpr int kFewestForDrift = 4;  // two degrees of freedom of the residual

double Median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  if (values.size() % 2 == 1) return values[middle];
  return 0.5 * (values[middle - 1] + values[middle]);
}

// First to last along the least-squares line, when it is more than its noise explains.
std::optional<double> Drift(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  if (values.size() < kFewestForDrift) return std::nullopt;
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
  const double standard_error = std::sqrt(rest / (n - 2.0) / sxx);
  const double drift = slope * (n - 1.0);
  const bool shown = std::abs(slope) > kDriftStandardErrors * standard_error &&
                     std::abs(drift) > kDriftRelative * std::abs(mean);
  return shown ? std::optional(drift) : std::nullopt;
}

void AddWarnings(const Warnings& more, Warnings& kept) {
  for (const Warning& warning : more) {
    const bool known =
        std::ranges::any_of(kept, [&](const Warning& k) { return k.code == warning.code; });
    if (!known) kept.push_back(warning);
  }
}

}  // namespace

std::optional<Summary> Summarise(std::span<const MeterReading> measurements) {
  std::vector<double> values;
  for (const MeterReading& m : measurements) {
    if (!m.reading.illuminance) return std::nullopt;
    values.push_back(m.reading.illuminance->value());
  }
  if (values.empty()) return std::nullopt;
  const double median = Median(values);
  const auto distance = [&](double v) { return std::abs(v - median); };
  const auto nearest = std::ranges::min_element(values, {}, distance) - values.begin();

  Summary summary{measurements[static_cast<std::size_t>(nearest)], static_cast<int>(values.size()),
                  0.0};
  Reading& reading = summary.kept.reading;
  reading.illuminance = Lux(median);
  if (median > 0.0) {
    std::vector<double> deviations;
    deviations.reserve(values.size());
    for (const double v : values) deviations.push_back(distance(v));
    summary.spread_relative = kSigmaPerMad * Median(std::move(deviations)) / median;
    reading.sigma_relative =
        std::max(reading.sigma_relative.value_or(0.0), summary.spread_relative);
  }
  for (const MeterReading& m : measurements) AddWarnings(m.warnings, summary.kept.warnings);
  if (const auto drift = Drift(values)) {
    summary.kept.warnings.push_back(
        {"drift", reading.device,
         "the readings drift by " + RoundedText(100.0 * *drift / median, 2) +
             " % from first to last; let the lamp warm up and measure again"});
  }
  return summary;
}

}  // namespace lightcal
