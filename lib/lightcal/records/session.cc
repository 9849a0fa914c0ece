// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace lightcal {

double SigmaRelative(const Session& session, const Reading& reading) {
  if (reading.sigma_relative) return *reading.sigma_relative;
  const MeterDescription* const meter = FindMeter(session, reading.meter);
  if (meter != nullptr) {
    return std::hypot(meter->sigma_relative, meter->repeatability_relative.value_or(0.0));
  }
  return reading.meter == kDataSheetMeter ? kSigmaDataSheet : kSigmaUnnamedMeter;
}

double CalibrationRelative(const Session& session, const Reading& reading) {
  if (reading.scale) return reading.scale->sigma;
  if (reading.meter == kDataSheetMeter || reading.quality == MeterQuality::kDerived) return 0.0;
  const MeterDescription* const meter = FindMeter(session, reading.meter);
  const bool described = meter != nullptr;
  if (described && meter->calibration_relative) return *meter->calibration_relative;
  const bool own = reading.sigma_relative && InstrumentOf(reading).empty();
  if (own) return 0.0;
  const double sigma = SigmaRelative(session, reading);
  return described ? std::min(sigma, meter->sigma_relative) : sigma;
}

double RepeatabilityBeside(double sigma, double calibration) {
  constexpr double kRepeatability = 0.01;
  const double square = sigma * sigma - calibration * calibration;
  const double least = std::min(kRepeatability, sigma);
  return std::sqrt(std::max(square, least * least));
}

double RepeatabilityRelative(const Session& session, const Reading& reading) {
  const MeterDescription* const meter = FindMeter(session, reading.meter);
  const bool stated = meter != nullptr && meter->repeatability_relative;
  if (stated && !reading.sigma_relative) return *meter->repeatability_relative;
  return RepeatabilityBeside(SigmaRelative(session, reading),
                             CalibrationRelative(session, reading));
}

const MeterDescription* FindMeter(const Session& session, std::string_view name) {
  const auto found = std::ranges::find(session.meters, name, &MeterDescription::name);
  return found == session.meters.end() ? nullptr : &*found;
}

const std::string& InstrumentOf(const Reading& reading) {
  if (reading.scale) return reading.scale->instrument;
  return reading.meter.empty() ? reading.device : reading.meter;
}

void NameOnlyMeter(Session& session) {
  if (session.meters.size() != 1) return;
  for (auto* const rows : {&session.readings, &session.state_readings}) {
    for (SessionReading& row : *rows) {
      Reading& reading = row.reading;
      const bool somebodys = !reading.meter.empty() || !reading.device.empty() ||
                             reading.sigma_relative || reading.scale ||
                             reading.quality == MeterQuality::kDerived;
      if (reading.illuminance && !somebodys) reading.meter = session.meters.front().name;
    }
  }
}

std::string PathInSession(const Session& session, const std::string& name) {
  return (std::filesystem::path(session.directory) / name).string();
}

const LightDescription* FindLight(const Session& session, std::string_view name) {
  const auto found = std::ranges::find(session.lights, name, &LightDescription::name);
  return found == session.lights.end() ? nullptr : &*found;
}

LampClass ClassOfLamp(const Session& session, std::string_view light) {
  const LightDescription* const described = FindLight(session, light);
  if (described != nullptr && described->lamp_class != LampClass::kUnknown) {
    return described->lamp_class;
  }
  for (const CaptureDescription& capture : session.captures) {
    if (capture.light == light && capture.lamp_class != LampClass::kUnknown) {
      return capture.lamp_class;
    }
  }
  return LampClass::kUnknown;
}

}  // namespace lightcal
