// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace lightcal {

double SigmaRelative(const Session& session, const Reading& reading) {
  if (reading.sigma_relative) return *reading.sigma_relative;
  const auto meter = std::ranges::find(session.meters, reading.meter, &MeterDescription::name);
  if (meter != session.meters.end()) return meter->sigma_relative;
  return reading.meter == kDataSheetMeter ? kSigmaDataSheet : kSigmaUnnamedMeter;
}

double CalibrationRelative(const Session& session, const Reading& reading) {
  if (reading.meter == kDataSheetMeter || reading.quality == MeterQuality::kDerived) return 0.0;
  const auto meter = std::ranges::find(session.meters, reading.meter, &MeterDescription::name);
  const bool described = meter != session.meters.end();
  if (described && meter->calibration_relative) return *meter->calibration_relative;
  const bool own = reading.sigma_relative && InstrumentOf(reading).empty();
  return own ? 0.0 : SigmaRelative(session, reading) / std::numbers::sqrt2;
}

double RepeatabilityRelative(const Session& session, const Reading& reading) {
  constexpr double kLeastShare = 0.1;
  const double sigma = SigmaRelative(session, reading);
  const double calibration = CalibrationRelative(session, reading);
  const double square = sigma * sigma - calibration * calibration;
  return std::sqrt(std::max(square, kLeastShare * kLeastShare * sigma * sigma));
}

const std::string& InstrumentOf(const Reading& reading) {
  return reading.meter.empty() ? reading.device : reading.meter;
}

std::string PathInSession(const Session& session, const std::string& name) {
  return (std::filesystem::path(session.directory) / name).string();
}

const LightDescription* FindLight(const Session& session, std::string_view name) {
  const auto found = std::ranges::find(session.lights, name, &LightDescription::name);
  return found == session.lights.end() ? nullptr : &*found;
}

}  // namespace lightcal
