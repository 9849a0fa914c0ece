// SPDX-License-Identifier: Apache-2.0
#include "calibration_options.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <utility>

#include "clock.h"
#include "guide/shell_word.h"
#include "input_files.h"
#include "lightcal/core/units_text.h"
#include "lightcal_devices/disk_sources.h"
#include "output_files.h"
#include "progress_line.h"

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
  AddLightsOptions(parser, options);
}

void AddLightsOptions(CLI::App& parser, CalibrationOptions& options) {
  auto* const only =
      parser.add_option("--lights", options.lights, "Only these of the lights, e.g. key,fill")
          ->delimiter(',')
          ->allow_extra_args(false);
  parser
      .add_option("--without", options.without,
                  "All but these of the lights, e.g. those that cannot be fitted")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->excludes(only);
}

namespace {

Result<AccuracyProfile> ProfileAsked(const CalibrationOptions& options) {
  AccuracyProfile profile;
  if (!options.profile.empty()) {
    const auto text = ReadInputFile(options.profile);
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

Result<CalibrationSettings> SettingsAsked(const CalibrationOptions& options) {
  auto profile = ProfileAsked(options);
  if (!profile) return Propagate(std::move(profile));
  CalibrationSettings settings;
  settings.profile = *std::move(profile);
  settings.monte_carlo = options.monte_carlo;
  settings.full_angles = options.full_angles;
  settings.lights = options.lights;
  settings.without = options.without;
  return settings;
}

namespace {

void Say(const Remarks& remarks, Console& console) {
  console.Warn(remarks.warnings);
  for (const std::string& note : remarks.notes) console.Note(note);
}

template <class T>
Result<T> Told(Calibrated<T>&& answer, Console& console) {
  Say(answer ? answer->remarks : answer.error().remarks, console);
  if (!answer) return tl::unexpected<Error>(std::move(answer).error());
  return *std::move(answer);
}

Calibrated<CalibratedSession> FromDisk(const std::string& path, CalibrationSettings settings,
                                       const Console& console) {
  settings.time = SourceDateIso8601().value_or("");
  const auto roots = RootsOfSession(path, console.allows_outside());
  if (!roots) return tl::unexpected(CalibrationRefusal{roots.error(), {}});
  return CalibrateSession(path, InputSourcesWithin(*roots), settings);
}

// "10 lights can be fitted without lamp 03, lamp 07: --without 'lamp 03,lamp 07'"
std::string WayOn(const CalibrationRefusal& refusal, const std::vector<std::string>& without) {
  std::string names;
  for (const std::string& left_out : without) names += left_out + ",";
  names += refusal.subject;
  for (const Error& other : refusal.others) names += "," + other.subject;
  const std::size_t count = refusal.sound.size();
  return (count == 1 ? "the other light is"
                     : "the other " + std::to_string(count) + " lights are") +
         std::string(" answered by --without ") + ShellWord(names);
}

}  // namespace

Result<CalibratedSession> Calibrate(const CalibrationOptions& options, Console& console) {
  auto settings = SettingsAsked(options);
  if (!settings) return tl::unexpected(settings.error());
  ProgressLine line("sampling intervals", !console.quiet());
  settings->progress = line.Watcher();
  auto calibrated = FromDisk(options.session, *settings, console);
  line.Wipe();
  if (!calibrated && !calibrated.error().sound.empty() && options.lights.empty()) {
    console.Note(WayOn(calibrated.error(), options.without));
  }
  return Told(std::move(calibrated), console);
}

Result<MeasuredSession> MeasureAloud(const std::string& path, const CalibrationSettings& settings,
                                     Console& console) {
  const auto roots = RootsOfSession(path, console.allows_outside());
  if (!roots) return tl::unexpected(roots.error());
  return Told(MeasureSession(path, InputSourcesWithin(*roots), settings), console);
}

Result<CalibratedSession> CalibrateAloud(const std::string& path, CalibrationSettings settings,
                                         Console& console) {
  return Told(FromDisk(path, std::move(settings), console), console);
}

std::string DefaultOutputDirectory(const Session& session) {
  return (std::filesystem::path(session.directory) / "out").string();
}

Result<double> ParseTolerance(const std::string& text) {
  const auto split = SplitNumberAndUnit(text);
  if (!split) return tl::unexpected(split.error());
  const double tolerance = split->unit == "%" ? split->number / 100.0 : split->number;
  const bool known_unit = split->unit.empty() || split->unit == "%";
  if (!known_unit || !(tolerance > 0.0) || tolerance >= 1.0) {
    return WrongUsage(text, "a tolerance is a part of one above 0 and below 1, e.g. 1% or 0.01");
  }
  return tolerance;
}

}  // namespace lightcal::app
