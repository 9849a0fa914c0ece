// SPDX-License-Identifier: Apache-2.0
// lightcal plan SESSION: the next readings of every light, and how sure it will then be.
#pragma once

#include <string>

#include "calibration_options.h"
#include "console.h"
#include "lightcal/core/result.h"
#include "minutes_answer.h"

namespace lightcal::app {

struct SessionPlanOptions {
  CalibrationOptions calibration;
  std::string light;  // "" = all
  int steps = 3;
  MinutesOptions minutes;
  bool force = false;
  bool with_minutes = false;  // any of those was given
  bool reach_stated = false;  // for the readings too, not for the minutes alone
};

// Prints the plan. A light whose readings are refused shows what the refusal asks for; refused only
// where every light is. Fails as MeasureSession.
[[nodiscard]] Result<void> PlanSession(const SessionPlanOptions& options, Console& console);

}  // namespace lightcal::app
