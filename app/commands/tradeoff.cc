// SPDX-License-Identifier: Apache-2.0
// lightcal tradeoff: what accuracy costs in time, on this very session.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "calibration_options.h"
#include "commands.h"
#include "interrupt.h"
#include "lightcal/core/units_text.h"
#include "output_files.h"
#include "preset_files.h"
#include "tradeoff/tradeoff_answer.h"

namespace lightcal::app {
namespace {

struct Options {
  std::string session, tolerance = "1%", budget, output;
  std::vector<std::string> knobs;
  bool force = false;
};

Result<tradeoff::Question> QuestionOf(const Options& options) {
  tradeoff::Question question;
  const auto tolerance = ParseTolerance(options.tolerance);
  if (!tolerance) return tl::unexpected(tolerance.error());
  question.tolerance_relative = *tolerance;
  question.knobs = options.knobs;
  if (options.budget.empty()) return question;
  const auto split = SplitNumberAndUnit(options.budget);
  const double scale = !split ? 0.0 : split->unit == "ms" ? 1e-3 : split->unit == "s" ? 1.0 : 0.0;
  if (!(scale > 0.0) || !(split->number > 0.0)) {
    return WrongUsage("--budget " + options.budget, "is no time; write 50ms or 2s");
  }
  question.budget_s = split->number * scale;
  return question;
}

// Runs the whole job in memory: session to presets, nothing written.
tradeoff::Runner RunnerOf(const std::string& session) {
  return [session](const AccuracyProfile& profile) -> Result<tradeoff::Outcome> {
    Console silent({.json = true, .quiet = true, .verbose = false, .strict = false, .muted = true});
    StageClock clock;
    auto calibrated =
        CalibrateSession(session, CalibrationRequest{profile, false, false, &clock}, silent);
    if (!calibrated) return Propagate(std::move(calibrated));
    Warnings warnings;
    const auto presets =
        PresetFiles(calibrated->lights, calibrated->session.stem, {}, {}, warnings);
    if (!presets) return tl::unexpected(presets.error());
    clock.Lap(tradeoff::Stage::kExport);
    return tradeoff::Outcome{tradeoff::FiguresOf(calibrated->lights), clock.seconds()};
  };
}

// One line on a terminal that counts up, and is wiped at the end.
class Progress {
 public:
  explicit Progress(bool shown) : shown_(shown && ::isatty(STDERR_FILENO) == 1) {}
  ~Progress() {
    if (shown_) std::cerr << "\r\033[K" << std::flush;
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void At(double share) {
    if (share < last_) ++phase_;
    last_ = share;
    if (!shown_) return;
    std::cerr << "\r\033[K" << (phase_ == 0 ? "measuring each knob " : "measuring combinations ")
              << std::lround(100.0 * share) << " %" << std::flush;
  }

 private:
  bool shown_;
  double last_ = 0.0;
  int phase_ = 0;
};

Result<tradeoff::Study> Measure(const Options& options, const tradeoff::Question& question,
                                bool quiet) {
  const InterruptGuard guard;
  Progress progress(!quiet);
  return tradeoff::StudyTradeoff(RunnerOf(options.session), question,
                                 {[] { return InterruptGuard::Wish().Requested(); },
                                  [&](double share) { progress.At(share); }});
}

Result<void> RunTradeoff(const Options& options, Console& console) {
  const auto question = QuestionOf(options);
  if (!question) return tl::unexpected(question.error());
  // Once aloud: what the session's own warnings are.
  CalibrationRequest usual;
  usual.profile.tolerance_relative = question->tolerance_relative;
  auto calibrated = CalibrateSession(options.session, usual, console);
  if (!calibrated) return Propagate(std::move(calibrated));
  const auto study = Measure(options, *question, console.json());
  if (!study) return tl::unexpected(study.error());
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;

  const Session& session = calibrated->session;
  if (!options.output.empty()) {
    auto files = TradeoffFiles(*study, question->tolerance_relative,
                               session.name.empty() ? session.stem : session.name);
    if (!files) return Propagate(std::move(files));
    PlaceUnder(options.output, *files);
    if (auto written = WriteOutputs(*files, options.force); !written) return written;
    for (const OutputFile& file : *files) console.Note("wrote " + file.path);
  }
  console.Print(TradeoffTable(*study) + "\n");
  for (const std::string& sentence : TradeoffSentences(*study)) console.Print(sentence + "\n");
  if (!options.output.empty()) {
    console.Print("next: lightcal run " + options.session + " --profile " + options.output +
                  "/profile.json\n");
  }
  console.PrintJson(TradeoffJson(*study, question->tolerance_relative));
  return {};
}

}  // namespace

Run BuildTradeoff(CLI::App& parser) {
  auto options = std::make_shared<Options>();
  parser.add_option("session", options->session, "Session directory or .toml file")->required();
  parser.add_option("--tol", options->tolerance, "How far from the strictest setting is allowed")
      ->capture_default_str();
  parser.add_option("--budget", options->budget,
                    "The most accurate setting within this time: 50ms");
  parser.add_option("--knobs", options->knobs, "Which knobs to move [all]")
      ->delimiter(',')
      ->allow_extra_args(false);
  parser.add_option("-o,--output", options->output,
                    "Where profile.json, the figure and the page go [nothing is written]");
  parser.add_flag("--force", options->force, "Replace files that lightcal did not write");
  return [options](Console& console) { return RunTradeoff(*options, console); };
}

}  // namespace lightcal::app
