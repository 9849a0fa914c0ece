// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/display_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "lightcal/core/units_text.h"

namespace lightcal {
namespace {

// Displays show tenths and hundredths of lux, or of footcandles; files may hold more digits.
constexpr std::array<std::pair<double, double>, 3> kUnitAndFinest = {
    {{1.0, 1e-3}, {kLuxPerFootcandle, 1e-3}, {1.0, 1e-5}}};

bool ByDisplay(const Reading& reading) {
  return !reading.scale && reading.meter != kDataSheetMeter &&
         reading.quality != MeterQuality::kDerived &&
         !(reading.sigma_relative && !reading.device.empty());
}
bool IsShown(const Reading& reading) {
  return reading.illuminance && !reading.over_range && !reading.under_range && ByDisplay(reading);
}

bool IsMultiple(double lux, double step) {
  const double steps = lux / step;
  return std::abs(steps - std::round(steps)) <= 1e-9 * std::abs(steps);
}

}  // namespace

double DisplayStepOf(const Session& session, const Reading& like) {
  if (!ByDisplay(like)) return 0.0;
  const std::string& instrument = InstrumentOf(like);
  std::set<double> shown;
  VisitReadings(session, [&](const SessionReading& row) {
    if (!IsShown(row.reading) || InstrumentOf(row.reading) != instrument) return;
    shown.insert(row.reading.illuminance->value());
  });
  if (shown.empty()) return 0.0;
  const auto all_of = [&](double step) {
    return std::ranges::all_of(shown, [step](double lux) { return IsMultiple(lux, step); });
  };
  constexpr std::size_t kEnough = 4;
  for (const double coarse : {10.0, 5.0}) {
    if (shown.size() >= kEnough && all_of(coarse)) return coarse;
  }
  for (const auto& [unit, finest] : kUnitAndFinest) {
    double step = 1.0;
    while (step > 0.5 * finest && !all_of(step * unit)) step *= 0.1;
    if (step > 0.5 * finest) return step * unit;
  }
  return 0.0;
}

double SigmaOfDisplay(double step) { return step / std::sqrt(12.0); }

}  // namespace lightcal
