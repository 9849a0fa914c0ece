// SPDX-License-Identifier: Apache-2.0
// The options every command shares that fits a session: run, fit, explain.
#pragma once

#include <string>

#include "console.h"
#include "lightcal/core/result.h"
#include "session_input.h"

namespace CLI {
class App;
}

namespace lightcal::app {

struct CalibrationOptions {
  std::string session;
  std::string tolerance = "1%";
  std::string effects = "auto";
  bool monte_carlo = false;
  bool full_angles = false;
  std::string profile;  // a profile.json of tradeoff; what is asked for beside it comes first
  bool tolerance_given = false, effects_given = false;
};

// Adds SESSION, --tol, --effects and --profile; `options` must outlive parsing.
void AddCalibrationOptions(CLI::App& parser, CalibrationOptions& options);
// The same without SESSION, for commands that take several.
void AddCalibrationSettings(CLI::App& parser, CalibrationOptions& options);

// What the options ask for, and CalibrateSession by it. Wrong usage: a tolerance outside 0..1.
// Refused as AccuracyProfileFromJson.
[[nodiscard]] Result<CalibrationRequest> RequestAsked(const CalibrationOptions& options);
[[nodiscard]] Result<CalibratedSession> Calibrate(const CalibrationOptions& options,
                                                  Console& console);

}  // namespace lightcal::app
