// SPDX-License-Identifier: Apache-2.0
#include "calibration_options.h"

#include <CLI/CLI.hpp>
#include <utility>

#include "output_files.h"

namespace lightcal::app {

void AddCalibrationOptions(CLI::App& parser, CalibrationOptions& options) {
  parser.add_option("session", options.session, "Session directory or .toml file")->required();
  AddCalibrationSettings(parser, options);
}

void AddCalibrationSettings(CLI::App& parser, CalibrationOptions& options) {
  parser
      .add_option_function<std::string>(
          "--tol",
          [&options](const std::string& text) {
            options.tolerance = text;
            options.tolerance_given = true;
          },
          "Tolerance of the effect gate")
      ->default_str(options.tolerance);
  parser
      .add_option_function<std::string>(
          "--effects",
          [&options](const std::string& text) {
            options.effects = text;
            options.effects_given = true;
          },
          "auto, all, none, or +name,-name")
      ->default_str(options.effects);
  parser.add_flag("--full-angles", options.full_angles,
                  "inner_deg and outer_deg of the session are full angles");
  parser.add_flag("--monte-carlo", options.monte_carlo,
                  "Intervals by sampling (JCGM 101, two digits) instead of the covariance");
  parser.add_option("--profile", options.profile, "A profile.json that lightcal tradeoff wrote");
}

namespace {

Result<AccuracyProfile> ProfileAsked(const CalibrationOptions& options) {
  AccuracyProfile profile;
  if (!options.profile.empty()) {
    const auto text = ReadWholeFile(options.profile);
    if (!text) return tl::unexpected(text.error());
    auto read = AccuracyProfileFromJson(*text, options.profile);
    if (!read) return Propagate(std::move(read));
    profile = *std::move(read);
  }
  if (options.profile.empty() || options.tolerance_given) {
    const auto tolerance = ParseTolerance(options.tolerance);
    if (!tolerance) return tl::unexpected(tolerance.error());
    profile.tolerance_relative = *tolerance;
  }
  if (options.profile.empty() || options.effects_given) profile.effects = options.effects;
  return profile;
}

}  // namespace

Result<CalibrationRequest> RequestAsked(const CalibrationOptions& options) {
  auto profile = ProfileAsked(options);
  if (!profile) return Propagate(std::move(profile));
  return CalibrationRequest{*std::move(profile), options.monte_carlo, options.full_angles, nullptr};
}

Result<CalibratedSession> Calibrate(const CalibrationOptions& options, Console& console) {
  const auto request = RequestAsked(options);
  if (!request) return tl::unexpected(request.error());
  return CalibrateSession(options.session, *request, console);
}

}  // namespace lightcal::app
