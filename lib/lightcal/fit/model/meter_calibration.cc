// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/meter_calibration.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lightcal/core/numbers_text.h"

namespace lightcal::fit {
namespace {

constexpr const char* kMeterCalibration = "meter_calibration";

}  // namespace

double SharedCalibration(const Observations& observations) {
  struct Instrument {
    double calibration = 0.0, weight = 0.0;
  };
  std::map<int, Instrument> instruments;
  double whole = 0.0;
  for (const Observation& o : observations.rows) {
    if (!o.lit || !(o.calibration > 0.0)) continue;
    Instrument& one = instruments[o.instrument];
    one.calibration = std::max(one.calibration, o.calibration);
    const double weight = std::pow(o.measured_lx / o.sigma_lx, 2.0);
    one.weight += weight;
    whole += weight;
  }
  if (instruments.empty()) return 0.0;
  if (instruments.size() == 1 || !(whole > 0.0)) return instruments.begin()->second.calibration;
  double variance = 0.0;
  for (const auto& [number, one] : instruments) {
    variance += std::pow(one.calibration * one.weight / whole, 2.0);
  }
  return std::sqrt(variance);
}

void AddCalibration(double calibration, LightEstimate& estimate) {
  const Theta shift = {calibration, 0.0, calibration * estimate.theta[kAmbient]};
  for (int i = 0; i < kParameters; ++i) {
    for (int j = 0; j < kParameters; ++j) {
      estimate.covariance[i * kParameters + j] += shift[i] * shift[j];
    }
  }
  estimate.variance_parts.push_back({kMeterCalibration, calibration * calibration});
}

std::vector<BudgetPart> BudgetWithScale(const Observations& observations,
                                        std::vector<VariancePart> parts) {
  for (VariancePart& part : parts) {
    if (observations.by_camera && part.name == kMeterCalibration) part.name = kCameraScale;
  }
  return BudgetOf(parts);
}

std::optional<MeterShare> MeterOf(const Session& session, const std::string& light,
                                  const Observations& observations) {
  if (observations.by_camera) return std::nullopt;
  std::optional<MeterShare> meter;
  const double calibration = SharedCalibration(observations);
  for (const SessionReading& row : session.readings) {
    const Reading& reading = row.reading;
    if (reading.light != light || !reading.illuminance) continue;
    const std::string& name = InstrumentOf(reading);
    if (meter && meter->name != name) return std::nullopt;
    if (!meter) meter = MeterShare{name, calibration};
  }
  return calibration > 0.0 ? meter : std::nullopt;
}

void ReportCalibration(const Observations& observations, std::vector<EffectReport>& effects) {
  const double calibration = SharedCalibration(observations);
  if (!(calibration > 0.0)) return;
  EffectReport report;
  report.name = observations.by_camera ? kCameraScale : kMeterCalibration;
  report.state = EffectState::kOn;
  report.bound = kZ95 * calibration;
  report.cost_ns = 1.0;
  report.key = observations.by_camera ? "capture.anchor_illuminance_lx" : "meter.sigma_relative";
  const std::string whose = observations.by_camera ? "the camera's" : "the meter's";
  const std::string lower = observations.by_camera
                                ? ", but one lux reading does"
                                : ", and it cancels in the ratio of two lamps read with one meter";
  report.reason = whose + " own scale, within " + PercentText(report.bound) +
                  ", widens the interval: repeating does not lower it" + lower;
  effects.push_back(std::move(report));
}

}  // namespace lightcal::fit
