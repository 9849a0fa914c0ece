// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/display_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
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
  if (const MeterDescription* const meter = FindMeter(session, like.meter); meter && meter->step) {
    return meter->step->value();
  }
  const std::string& instrument = InstrumentOf(like);
  const auto whole = session.display_steps.find(instrument);
  if (whole != session.display_steps.end()) return whole->second.value();
  std::set<double> shown;
  bool lamp_shows_nothing = false;  // a figure too, as nothing behind a card or in the dark is not
  VisitReadings(session, [&](const SessionReading& row) {
    if (!IsShown(row.reading) || InstrumentOf(row.reading) != instrument) return;
    const double lux = row.reading.illuminance->value();
    shown.insert(lux);
    lamp_shows_nothing = lamp_shows_nothing || (lux == 0.0 && IsLit(row.reading));
  });
  if (shown.empty()) return 0.0;
  const auto all_of = [&](double step) {
    return std::ranges::all_of(shown, [step](double lux) { return IsMultiple(lux, step); });
  };
  // A display of 1 lx shows a multiple of `coarse` once in so many figures: less than once in 500
  // sessions is no chance, three different tens or four fives.
  constexpr double kNoChance = 1.0 / 500.0;
  const auto telling =
      static_cast<double>(shown.size() - (lamp_shows_nothing ? 0 : shown.count(0.0)));
  for (const double coarse : {10.0, 5.0}) {
    if (std::pow(coarse, -telling) < kNoChance && all_of(coarse)) return coarse;
  }
  for (const auto& [unit, finest] : kUnitAndFinest) {
    double step = 1.0;
    while (step > 0.5 * finest && !all_of(step * unit)) step *= 0.1;
    if (step > 0.5 * finest) return step * unit;
  }
  return 0.0;
}

std::map<std::string, Lux> DisplaySteps(const Session& session) {
  std::map<std::string, Lux> steps;
  VisitReadings(session, [&](const SessionReading& row) {
    if (!IsShown(row.reading)) return;
    const std::string& instrument = InstrumentOf(row.reading);
    if (!steps.contains(instrument)) steps[instrument] = Lux(DisplayStepOf(session, row.reading));
  });
  return steps;
}

double SigmaOfDisplay(double step) { return step / std::sqrt(12.0); }

}  // namespace lightcal
