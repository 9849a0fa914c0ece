// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/meter_calibration.h"

#include <algorithm>
#include <utility>

#include "lightcal/core/numbers_text.h"

namespace lightcal::fit {

double LargestCalibration(const Observations& observations) {
  double largest = 0.0;
  for (const Observation& o : observations.rows) {
    if (o.lit) largest = std::max(largest, o.calibration);
  }
  return largest;
}

void AddCalibration(double calibration, LightEstimate& estimate) {
  const Theta shift = {calibration, 0.0, calibration * estimate.theta[kAmbient]};
  for (int i = 0; i < kParameters; ++i) {
    for (int j = 0; j < kParameters; ++j) {
      estimate.covariance[i * kParameters + j] += shift[i] * shift[j];
    }
  }
  estimate.variance_parts.push_back({"meter_calibration", calibration * calibration});
}

std::optional<MeterShare> MeterOf(const Session& session, const std::string& light,
                                  const Observations& observations) {
  std::optional<MeterShare> meter;
  const double calibration = LargestCalibration(observations);
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
  const double calibration = LargestCalibration(observations);
  if (!(calibration > 0.0)) return;
  EffectReport report;
  report.name = "meter_calibration";
  report.state = EffectState::kOn;
  report.bound = kZ95 * calibration;
  report.cost_ns = 1.0;
  report.key = "meter.sigma_relative";
  report.reason = "the meter's own scale, within " + PercentText(report.bound) +
                  ", widens the interval: repeating does not lower it, and it cancels in the "
                  "ratio of two lamps read with one meter";
  effects.push_back(std::move(report));
}

}  // namespace lightcal::fit
