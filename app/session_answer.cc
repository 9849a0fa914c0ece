// SPDX-License-Identifier: Apache-2.0
#include "session_answer.h"

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/calibrate/export_presets.h"
#include "lightcal/calibrate/states/control_sweeps.h"
#include "lightcal/core/parallel.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/records/light_codec.h"
#include "progress_line.h"
#include "report_html.h"

namespace lightcal::app {
namespace {

// Titles of the engines that were named; none where all were, or nobody said.
std::vector<std::string> EnginesAsked(const std::vector<LampAnswer>& answers,
                                      const std::vector<std::string>& targets) {
  std::vector<std::string> titles;
  if (targets.empty() || targets.size() == PresetTargets().size()) return titles;
  for (const LampAnswer& answer : answers) {
    for (const EngineFigure& figure : answer.figures) titles.push_back(figure.engine);
  }
  return titles;
}

}  // namespace

Result<AnsweredSession> AnswerSession(const CalibrationOptions& options,
                                      const std::vector<std::string>& targets, Console& console) {
  auto calibrated = Calibrate(options, console);
  if (!calibrated) return Propagate(std::move(calibrated));
  AnsweredSession run;
  run.calibrated = *std::move(calibrated);
  ProgressLine line("planning the next readings", !console.quiet());
  run.answers = SessionAnswersOf(run.calibrated, options.session, targets, line.Watcher());
  return run;
}

Result<std::vector<OutputFile>> SessionOutputs(const AnsweredSession& run,
                                               const std::string& directory,
                                               const std::vector<std::string>& targets, bool rig,
                                               Console& console) {
  const LightFile& lights = run.calibrated.lights;
  const std::string& stem = run.calibrated.session.stem;
  const std::vector<ControlSweep> sweeps = ControlSweepsOf(lights);
  Result<std::string> json;
  Result<ExportedPresets> presets;
  std::string report;
  const std::array<std::function<void()>, 3> jobs = {
      [&] {
        report =
            ReportHtml(run.calibrated, run.answers.engines, sweeps,
                       EnginesAsked(run.answers.lamps, targets), AdviceOf(run.answers.lamps, stem));
      },
      [&] { presets = ExportPresets(lights, targets, stem, {.rig = rig, .sweeps = sweeps}); },
      [&] { json = LightFileToJson(lights); }};
  ParallelFor(static_cast<int>(jobs.size()), [&](int i) { jobs[static_cast<std::size_t>(i)](); });
  if (!json) return Propagate(std::move(json));
  if (!presets) return Propagate(std::move(presets));
  console.Warn(presets->warnings);
  std::vector<OutputFile> files = {{"light.json", std::move(*json)},
                                   {"report.html", std::move(report)}};
  for (PresetFile& file : presets->files) {
    files.push_back({std::move(file.name), std::move(file.contents)});
  }
  PlaceUnder(directory, files);
  return files;
}

Node DocumentOf(const AnsweredSession& run) {
  Node next = Node::Table();
  for (const LampAnswer& answer : run.answers.lamps) {
    if (answer.light->fit.readings == 0) continue;  // a wall or a data sheet measured it
    next.Put(answer.light->name, answer.next.say);
  }
  Node document = DocumentOf(run.calibrated.lights);
  document.Put("next_steps", std::move(next));
  return document;
}

}  // namespace lightcal::app
