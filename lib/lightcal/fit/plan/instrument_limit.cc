// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/plan/instrument_limit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "lightcal/fit/model/data_sheet.h"

namespace lightcal::fit {

double SharedCalibrationOf(const Session& session, const Reading& like) {
  std::map<std::string, double> of_instrument;
  of_instrument[InstrumentOf(like)] = CalibrationRelative(session, like);
  for (const SessionReading& row : session.readings) {
    if (!IsLit(row.reading)) continue;
    of_instrument[InstrumentOf(row.reading)] = CalibrationRelative(session, row.reading);
  }
  double information = 0.0;
  for (const auto& [instrument, calibration] : of_instrument) {
    if (!(calibration > 0.0)) return 0.0;
    information += 1.0 / (calibration * calibration);
  }
  return 1.0 / std::sqrt(information);
}

std::optional<double> LeastDeviation(const Session& session, const Reading& like) {
  if (HasDataSheet(session.lights.front())) return std::nullopt;
  struct Instrument {
    double calibration = 0.0, information = 0.0;  // of its repeated readings
  };
  std::map<std::string, Instrument> instruments;
  const auto count = [&](const Reading& reading) {
    const double repeatability = RepeatabilityRelative(session, reading);
    const double calibration = CalibrationRelative(session, reading);
    Instrument& one =
        instruments.try_emplace(InstrumentOf(reading), Instrument{calibration}).first->second;
    one.calibration = std::min(one.calibration, calibration);
    one.information += 1.0 / (repeatability * repeatability);
  };
  count(like);
  for (const SessionReading& row : session.readings) {
    if (row.reading.illuminance) count(row.reading);
  }
  double information = 0.0;
  for (const auto& [name, one] : instruments) {
    information += 1.0 / (one.calibration * one.calibration + 1.0 / one.information);
  }
  return 1.0 / std::sqrt(information);
}

}  // namespace lightcal::fit
