// SPDX-License-Identifier: Apache-2.0
// lightcal tradeoff: what accuracy costs in time, on this very session.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>

#include "calibration_options.h"
#include "commands.h"
#include "directory_name.h"
#include "guide/shell_word.h"
#include "input_files.h"
#include "interrupt.h"
#include "lightcal/calibrate/session_twin.h"
#include "lightcal/core/units_text.h"
#include "lightcal/records/json_codec.h"
#include "lightcal_devices/disk_sources.h"
#include "minutes_answer.h"
#include "output_files.h"
#include "progress_line.h"
#include "tradeoff/tradeoff_answer.h"
#include "tradeoff/truth_answer.h"

namespace lightcal::app {
namespace {

struct TradeoffOptions {
  std::string session, tolerance = "1%", budget, output;
  std::vector<std::string> knobs;
  MinutesOptions minutes;
  bool synthetic = false, force = false;
};

Result<tradeoff::Question> QuestionOf(const TradeoffOptions& options) {
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

// A study measures one thing after the other, each from 0 to 1, and never takes less than seconds.
class StudyProgress {
 public:
  explicit StudyProgress(bool wanted) : line_(kPhases[0], wanted, 0.0) {}

  void At(double share) {
    if (share < last_) line_.Begin(kPhases[std::min(++phase_, kPhases.size() - 1)]);
    last_ = share;
    line_.At(share);
  }

 private:
  static constexpr std::array kPhases = {"measuring each knob", "measuring combinations",
                                         "making sure", "reading the twin again"};
  ProgressLine line_;
  double last_ = 0.0;
  std::size_t phase_ = 0;
};

// One run of a large session may take minutes, and nothing is written before the end.
EndAtOnce StoppedWith(bool json) {
  const Error stopped{ErrorKind::kFailed, "interrupted", "tradeoff",
                      "stopped; nothing was written"};
  const std::string out = PrintJson({{"error", DocumentOf(stopped)}}, records::JsonLayout::kPretty);
  const std::string wiped = ::isatty(STDERR_FILENO) == 1 ? "\r\x1b[K" : "";
  return {json ? out + "\n" : "",
          wiped + "lightcal: " + stopped.subject + ": " + stopped.message + "\n"};
}

Result<TradeoffAnswer> Measure(const TradeoffOptions& options, const tradeoff::Question& question,
                               bool json) {
  const EndAtOnce ends = StoppedWith(json);
  StudyProgress progress(!json);
  tradeoff::Watch watch;
  watch.progress = [&](double share) { progress.At(share); };
  TradeoffAnswer out;
  out.tolerance_relative = question.tolerance_relative;
  SessionTwin twin;
  if (options.synthetic) {
    auto made = TwinOf(options.session, InputSources(), question.tolerance_relative);
    if (!made) return Propagate(std::move(made));
    twin = *std::move(made);
  }
  const tradeoff::Runner run = options.synthetic
                                   ? TwinRunner(twin, devices::DiskSources)
                                   : SessionRunner(options.session, devices::DiskSources);
  auto study = tradeoff::StudyTradeoff(run, question, watch);
  if (!study) return Propagate(std::move(study));
  out.study = *std::move(study);
  if (!options.synthetic) return out;
  const std::vector<tradeoff::Named> settings = SettingsForTruth(out.study);
  auto truth = tradeoff::CompareWithTruth(TwinReplicas(twin, InputSources()), twin.truth, settings,
                                          {}, watch);
  if (!truth) return Propagate(std::move(truth));
  out.truth = *std::move(truth);
  if (question.budget_s) return out;
  auto judged =
      tradeoff::RecommendByTruth(run, question, watch, out.truth.front(), out.truth, out.study);
  if (!judged) return Propagate(std::move(judged));
  return out;
}

FitSettings FitSettingsAt(double tolerance_relative) {
  FitSettings settings;
  settings.tolerance_relative = tolerance_relative;
  return settings;
}

Result<std::vector<OutputFile>> Outputs(const TradeoffOptions& options,
                                        const TradeoffAnswer& answer, const Session& session) {
  auto files = MinutesPictures(options.minutes, answer.ladders);
  if (!files || options.output.empty()) return files;
  const std::string title = session.name.empty() ? session.stem : session.name;
  auto more = TradeoffFiles(answer, options.synthetic ? title + " (synthetic twin)" : title);
  if (!more) return more;
  PlaceUnder(options.output, *more);
  std::ranges::move(*more, std::back_inserter(*files));
  return files;
}

Result<void> RunTradeoff(const TradeoffOptions& options, Console& console) {
  const auto question = QuestionOf(options);
  if (!question) return tl::unexpected(question.error());
  const auto wishes = LadderWishesOf(options.minutes);
  if (!wishes) return tl::unexpected(wishes.error());
  // Once aloud: what the session's own warnings are.
  CalibrationSettings usual;
  usual.profile.tolerance_relative = question->tolerance_relative;
  auto calibrated = CalibrateAloud(options.session, usual, console);
  if (!calibrated) return Propagate(std::move(calibrated));
  auto answer = Measure(options, *question, console.json());
  if (!answer) return Propagate(std::move(answer));
  answer->ladders =
      LaddersOf(calibrated->session, FitSettingsAt(question->tolerance_relative), *wishes);
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  const auto files = Outputs(options, *answer, calibrated->session);
  if (!files) return tl::unexpected(files.error());
  if (auto written = WriteOutputs(*files, options.force); !written) return written;
  for (const OutputFile& file : *files) console.Note("wrote " + file.path);
  console.Print(TradeoffTable(*answer) + "\n");
  for (const std::string& sentence : TradeoffSentences(*answer)) console.Print(sentence + "\n");
  if (!options.output.empty() && answer->study.saved_share > 0.0) {
    console.Print("next: lightcal run " + ShellWord(options.session) + " --profile " +
                  ShellWord(options.output) + "/profile.json\n");
  }
  console.PrintDocument(TradeoffNode(*answer));
  return {};
}

}  // namespace

Run BuildTradeoff(CLI::App& parser) {
  auto options = std::make_shared<TradeoffOptions>();
  parser.add_option("session", options->session, "Session directory or .toml file")->required();
  parser.add_option("--tol", options->tolerance, "How far from the strictest setting is allowed")
      ->capture_default_str();
  parser.add_option("--budget", options->budget,
                    "The most accurate setting within this processor time: 50ms");
  parser.add_option("--knobs", options->knobs, "Which knobs to move [all]")
      ->delimiter(',')
      ->allow_extra_args(false);
  parser.add_flag(
      "--synthetic", options->synthetic,
      "On a synthetic twin: the fitted lamps, read anew with the meter's noise, so that "
      "settings are judged by their errors against the truth");
  AddMinutesOptions(parser, options->minutes);
  parser
      .add_option("-o,--output", options->output,
                  "Where profile.json, the figures and the page go [nothing is written]")
      ->check(DirectoryName());
  parser.add_flag("--force", options->force, "Replace files that lightcal did not write");
  return [options](Console& console) { return RunTradeoff(*options, console); };
}

}  // namespace lightcal::app
