// SPDX-License-Identifier: Apache-2.0
// What every command shares that calibrates a session: options, and warnings said aloud.
#pragma once

#include <string>
#include <vector>

#include "console.h"
#include "lightcal/calibrate/calibrate_session.h"
#include "lightcal/core/result.h"

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
  std::vector<std::string> lights, without;  // of the session's, these alone or all but these
  bool tolerance_given = false, effects_given = false;
};

// Adds SESSION and the settings; `options` must outlive parsing.
void AddCalibrationOptions(CLI::App& parser, CalibrationOptions& options);
// The same without SESSION, for commands that take several.
void AddCalibrationSettings(CLI::App& parser, CalibrationOptions& options);

// Which of the lights alone.
void AddLightsOptions(CLI::App& parser, CalibrationOptions& options);

// What the options ask for, and CalibrateAloud by it, with how to go on where only some lights are
// refused. Wrong usage: a tolerance outside 0..1. Refused as AccuracyProfileFromJson.
[[nodiscard]] Result<CalibrationSettings> SettingsAsked(const CalibrationOptions& options);
[[nodiscard]] Result<CalibratedSession> Calibrate(const CalibrationOptions& options,
                                                  Console& console);

// MeasureSession and CalibrateSession from disk, warnings and notes on the console, those of a
// refusal too. SOURCE_DATE_EPOCH is the time of provenance.
[[nodiscard]] Result<MeasuredSession> MeasureAloud(const std::string& path,
                                                   const CalibrationSettings& settings,
                                                   Console& console);
[[nodiscard]] Result<CalibratedSession> CalibrateAloud(const std::string& path,
                                                       CalibrationSettings settings,
                                                       Console& console);

// Where a session's outputs go when the person names no place: <session directory>/out.
[[nodiscard]] std::string DefaultOutputDirectory(const Session& session);

// "1%" or "0.01" -> 0.01.
[[nodiscard]] Result<double> ParseTolerance(const std::string& text);

}  // namespace lightcal::app
