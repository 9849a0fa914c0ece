// SPDX-License-Identifier: Apache-2.0
#include "calibration_options.h"

#include <CLI/CLI.hpp>

namespace lightcal::app {

void AddCalibrationOptions(CLI::App& parser, CalibrationOptions& options) {
  parser.add_option("session", options.session, "Session directory or .toml file")->required();
  parser.add_option("--tol", options.tolerance, "Tolerance of the effect gate")
      ->capture_default_str();
  parser.add_option("--effects", options.effects, "auto, all, none, or +name,-name")
      ->capture_default_str();
  parser.add_flag("--full-angles", options.full_angles,
                  "inner_deg and outer_deg of the session are full angles");
  parser.add_flag("--monte-carlo", options.monte_carlo,
                  "Intervals by sampling (JCGM 101, two digits) instead of the covariance");
}

Result<CalibratedSession> Calibrate(const CalibrationOptions& options, Console& console) {
  const auto tolerance = ParseTolerance(options.tolerance);
  if (!tolerance) return tl::unexpected(tolerance.error());
  return CalibrateSession(options.session, {*tolerance, options.effects, options.monte_carlo},
                          console, options.full_angles);
}

}  // namespace lightcal::app
