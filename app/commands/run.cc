// SPDX-License-Identifier: Apache-2.0
// lightcal run: the main job. Session in; light.json, presets and report out.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "calibration_options.h"
#include "commands.h"
#include "light_table.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/records/light_codec.h"
#include "one_of.h"
#include "output_files.h"
#include "preset_files.h"
#include "report_html.h"

namespace lightcal::app {
namespace {

struct Options {
  CalibrationOptions calibration;
  std::string output;
  std::vector<std::string> targets;
  bool bare = false;
  bool force = false;
};

Result<std::vector<OutputFile>> OutputsOf(const Options& options, const std::string& directory,
                                          const CalibratedSession& calibrated, Console& console) {
  const LightFile& lights = calibrated.lights;
  auto json = LightFileToJson(lights);
  if (!json) return Propagate(std::move(json));
  const Session& session = calibrated.session;
  const std::string& title = session.name.empty() ? session.stem : session.name;
  Warnings warnings;
  auto presets =
      PresetFiles(lights, session.stem, options.targets, {.bare = options.bare}, warnings);
  if (!presets) return Propagate(std::move(presets));
  console.Warn(warnings);
  std::vector<OutputFile> files = {{"light.json", std::move(*json)},
                                   {"report.html", ReportHtml(lights, title)}};
  for (OutputFile& file : presets->files) files.push_back(std::move(file));
  PlaceUnder(directory, files);
  return files;
}

Result<void> RunRun(const Options& options, Console& console) {
  auto calibrated = Calibrate(options.calibration, console);
  if (!calibrated) return Propagate(std::move(calibrated));
  const std::string directory =
      options.output.empty() ? DefaultOutputDirectory(calibrated->session) : options.output;
  const auto files = OutputsOf(options, directory, *calibrated, console);
  if (!files) return tl::unexpected(files.error());
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (auto written = WriteOutputs(*files, options.force); !written) return written;

  console.Print(LightTable(calibrated->lights) + "\n" + FitTable(calibrated->lights) + "\n");
  auto document = nlohmann::ordered_json::parse(files->front().contents);
  auto& next = document["next_steps"] = nlohmann::ordered_json::object();
  for (const FittedLight& light : calibrated->lights.lights) {
    if (light.fit.readings == 0) continue;  // a wall or a data sheet measured it
    next[light.name] = NextStep(calibrated->session, light);
    console.Print("next, " + light.name + ": " + std::string(next[light.name]) + "\n");
  }
  for (const OutputFile& file : *files) console.Print("wrote " + file.path + "\n");
  auto& written = document["files"] = nlohmann::ordered_json::array();
  for (const OutputFile& file : *files) written.push_back(file.path);
  console.PrintJson(document);
  return {};
}

}  // namespace

Run BuildRun(CLI::App& parser) {
  auto options = std::make_shared<Options>();
  AddCalibrationOptions(parser, options->calibration);
  parser.add_option("-o,--output", options->output, "Where everything goes [SESSION/out]");
  parser.add_option("--to", options->targets, "Presets to write [all]")
      ->check(OneOf(NamesOf(PresetTargets())))
      ->delimiter(',')
      ->allow_extra_args(false);
  parser.add_flag("--bare", options->bare, "Presets hold the lights only, no cards and camera");
  parser.add_flag("--force", options->force, "Replace files that lightcal did not write");
  return [options](Console& console) { return RunRun(*options, console); };
}

}  // namespace lightcal::app
