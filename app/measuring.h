// SPDX-License-Identifier: Apache-2.0
// How one reading is taken from a meter: wait until the lamp is warm, measure n times, keep the
// median.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "console.h"
#include "lightcal_devices/meters/summary.h"
#include "meter_session.h"

namespace lightcal::app {

inline constexpr int kDefaultMeasurements = 5;
// A lamp is given a quarter of an hour to settle, looked at every five seconds.
inline constexpr int kSettleMeasurements = 180;
inline constexpr std::chrono::seconds kSettlePause{5};

struct MeasuringPlan {
  // 0 = kDefaultMeasurements, or, of a tape, all that it holds.
  int measurements = 0;
  std::optional<int> from_memory;         // this stored reading instead, measurements aside
  std::optional<double> settle_relative;  // first wait until the light changes by less than this
};

// "406.96 lx"; "> 200000 lx" where the meter was over its range.
[[nodiscard]] std::string LuxText(const Reading& reading);

// Notes each measurement on stderr unless it is the only one. Fails as MeterSession::Measure;
// warns not_settled where the light still moved after kSettleMeasurements.
[[nodiscard]] Result<devices::Summary> TakeSummary(const MeasuringPlan& plan, MeterSession& meter,
                                                   Console& console);

}  // namespace lightcal::app
