// SPDX-License-Identifier: Apache-2.0
// lightcal run: the main job. Session in; light.json, presets and report out. Several sessions make
// a batch.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "batch/find_sessions.h"
#include "batch/run_batch.h"
#include "batch/run_stamp.h"
#include "calibration_options.h"
#include "clock.h"
#include "commands.h"
#include "directory_name.h"
#include "engine_colors.h"
#include "input_files.h"
#include "lamp_answer.h"
#include "light_table.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/records/session_codec.h"
#include "output_files.h"
#include "preset_flags.h"
#include "session_answer.h"
#include "target_words.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

struct RunOptions {
  CalibrationOptions calibration;
  std::vector<std::string> sessions;
  std::string output;
  std::vector<std::string> targets;
  bool rig = false;
  bool bare = false;  // what is done anyway
  bool force = false;
  // Of a batch.
  int jobs = 0;
  bool resume = false, recursive = false;
  std::string summary;
  // Given by main to every command; a batch hands them to each session's console.
  bool strict = false, quiet = false;
};

// What the outputs of one session were made from, where a batch keeps account of it.
using StampSeed = std::optional<RunStamp>;

OutputFile StampFile(RunStamp stamp, const std::string& directory, const LightFile& lights,
                     const std::vector<OutputFile>& files) {
  stamp.inputs = lights.provenance.inputs;
  for (const OutputFile& file : files) {
    const std::string name = fs::path(file.path).lexically_proximate(directory).generic_string();
    stamp.outputs.push_back({name, devices::Sha256Hex(file.contents)});
  }
  return {(fs::path(directory) / kRunStampFile).string(), RunStampToJson(stamp)};
}

Result<void> RunSession(const RunOptions& options, const StampSeed& stamp, Console& console) {
  const auto run = AnswerSession(options.calibration, options.targets, console);
  if (!run) return tl::unexpected(run.error());
  const LightFile& lights = run->calibrated.lights;
  const std::string directory =
      options.output.empty() ? DefaultOutputDirectory(run->calibrated.session) : options.output;
  auto files = SessionOutputs(*run, directory, options.targets, options.rig, console);
  if (!files) return Propagate(std::move(files));
  if (stamp) files->push_back(StampFile(*stamp, directory, lights, *files));
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (auto written = WriteOutputs(*files, options.force); !written) return written;

  console.Print(LampAnswersText(run->answers.lamps, run->calibrated.session));
  if (console.verbose()) {
    for (const LampAnswer& answer : run->answers.lamps) {
      const std::string colors = ColorLines(answer.figures);
      if (!colors.empty()) console.Print(answer.light->name + ":\n" + colors);
    }
    console.Print("\n" + LightTable(lights) + "\n" + FitTable(lights) + "\n");
  }
  console.Print(WroteLine(*files, directory) + "\n");
  Node document = DocumentOf(*run);
  document.Put("files", PathsOf(*files));
  console.PrintDocument(std::move(document));
  return {};
}

// All that decides what a session's outputs are, beside its own files.
Result<std::string> SettingsHash(const RunOptions& options) {
  const CalibrationOptions& asked = options.calibration;
  std::string text = asked.tolerance + '\n' + asked.effects + '\n';
  for (const bool flag : {asked.tolerance_given, asked.effects_given, asked.monte_carlo,
                          asked.full_angles, options.rig, options.strict}) {
    text += flag ? '1' : '0';
  }
  if (!asked.profile.empty()) {
    auto profile = ReadInputFile(asked.profile);
    if (!profile) return profile;
    text += '\n' + devices::Sha256Hex(*profile);
  }
  for (const auto* const names : {&asked.lights, &asked.without, &options.targets}) {
    for (const std::string& name : *names) text += '\n' + name;
    text += '\n';
  }
  return devices::Sha256Hex(text + '\n' + SourceDateIso8601().value_or(""));
}

Result<void> RunOfBatch(const RunOptions& options, const std::string& settings,
                        const BatchItem& item, Console& console) {
  const auto session_hash = NamedFilesHash(item.session);
  if (!session_hash) return tl::unexpected(session_hash.error());
  const std::string base = fs::path(JournalPath(item.session)).parent_path().string();
  if (options.resume && IsUpToDate(item.directory, base, settings, *session_hash)) {
    console.PrintDocument({{"up_to_date", true}});
    return {};
  }
  RemoveLeftovers(item.directory);
  RunOptions one = options;
  one.calibration.session = item.session;
  one.output = item.directory;
  return RunSession(one, RunStamp{GeneratorName(), settings, *session_hash, {}, {}}, console);
}

Result<void> RunRun(const RunOptions& options, Console& console) {
  const auto sessions = FindSessions(options.sessions, options.recursive);
  if (!sessions) return tl::unexpected(sessions.error());
  const bool one_named = *sessions == options.sessions && sessions->size() == 1;
  const bool accounted = options.resume || options.jobs > 0 || !options.summary.empty();
  if (one_named && !accounted) {
    RunOptions one = options;
    one.calibration.session = sessions->front();
    return RunSession(one, std::nullopt, console);
  }
  auto items = BatchItems(*sessions, options.output, !one_named);
  if (!items) return Propagate(std::move(items));
  const auto settings = SettingsHash(options);
  if (!settings) return tl::unexpected(settings.error());
  BatchRequest request;
  request.items = *std::move(items);
  request.jobs = options.jobs;
  request.summary = options.summary;
  request.progress = !options.quiet;
  request.strict = options.strict;
  request.allow_outside = console.allows_outside();
  request.run = [&](const BatchItem& item, Console& of_item) {
    return RunOfBatch(options, *settings, item, of_item);
  };
  return RunBatch(request, console);
}

}  // namespace

Run BuildRun(CLI::App& parser) {
  auto options = std::make_shared<RunOptions>();
  parser
      .add_option("sessions", options->sessions,
                  "Session directories or .toml files, folders of sessions, wildcards")
      ->required();
  AddCalibrationSettings(parser, options->calibration);
  parser
      .add_option("-o,--output", options->output,
                  "Where everything goes; of several sessions a folder for each [SESSION/out]")
      ->check(DirectoryName());
  parser.add_option("--to", options->targets, "Presets to write [all]")
      ->check(OneOf(TargetWords()))
      ->delimiter(',')
      ->allow_extra_args(false);
  AddSceneFlags(parser, options->rig, options->bare);
  parser.add_flag("--force", options->force, "Replace files that lightcal did not write");
  parser
      .add_option("--jobs", options->jobs,
                  "Sessions at once, each in a process of its own [processors]")
      ->check(CLI::Range(1, 1024));
  parser.add_flag("--recursive", options->recursive,
                  "Of a folder, every session at any depth below it, not only those in it");
  parser.add_flag(
      "--resume", options->resume,
      "Leave sessions alone whose inputs, settings and outputs are as a former run with "
      "--resume, or of several sessions, left them");
  parser.add_option("--summary", options->summary, "Write what became of each session")
      ->type_name("FILE.json");
  return [options, &parser](Console& console) {
    options->strict = parser.count("--strict") > 0;
    options->quiet = parser.count("--quiet") > 0;
    SpellOutAll(options->targets);
    return RunRun(*options, console);
  };
}

}  // namespace lightcal::app
