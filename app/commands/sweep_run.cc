// SPDX-License-Identifier: Apache-2.0
#include "sweep_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "calibration_options.h"
#include "guide/driven_fixture.h"
#include "guide/shell_word.h"
#include "guide/sweep_plan.h"
#include "guide/sweep_readings.h"
#include "input_files.h"
#include "interrupt.h"
#include "lightcal/core/interval_text.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"
#include "lightcal/core/units_text.h"
#include "lightcal/fit/states/state_answer.h"
#include "lightcal/records/journal.h"
#include "lightcal/records/session_codec.h"
#include "lightcal/records/session_reader.h"
#include "option_words.h"
#include "read_options.h"
#include "reading_source.h"
#include "session_names.h"
#include "taken_back.h"
#include "terminal.h"

namespace lightcal::app {
namespace {

// Light that changes by less than this many of the meter's repeatabilities stands still: six looks'
// least-squares line alone changes by 1.2 of them, 1 sigma.
constexpr double kStillSigmas = 2.5;
constexpr double kUnknownRepeatability = 0.004, kLeastRepeatability = 0.001,
                 kMostRepeatability = 0.01;

class Sweep {
 public:
  Sweep(const SweepOptions& options, std::vector<FixtureState> states, Console& console)
      : options_(options), states_(std::move(states)), console_(console) {}

  Result<void> Run() {
    const InterruptGuard guard;
    if (auto begun = Begin(); !begun) return begun;
    auto swept = options_.until.empty() ? TakeAll() : TakeUntil();
    const auto finished = source_.Finish(console_);
    if (!swept) return swept;
    if (!finished) return finished;
    Conclude();
    return {};
  }

 private:
  Result<void> Begin() {
    auto loaded = LoadSession(options_.session, InputSources().read_text);
    if (!loaded) return Propagate(std::move(loaded));
    console_.Warn(loaded->warnings);
    session_ = std::move(loaded->session);
    auto light = LightMeant(session_, options_.light);
    if (!light) return Propagate(std::move(light));
    frame_.light = *std::move(light);
    frame_.meter = options_.meter;
    if (auto named = CheckNames(session_, frame_.light, frame_.meter); !named) return named;
    Reading first = frame_;
    first.state = states_.front();
    if (auto fits = CheckState(session_, first); !fits) return fits;
    if (!options_.distance.empty()) {
      const auto distance = ParseLength(options_.distance);
      if (!distance) return tl::unexpected(distance.error());
      frame_.distance = *distance;
    }
    if (auto placed = CheckPlace(); !placed) return placed;
    if (!options_.until.empty()) {
      const auto until = ParseTolerance(options_.until);
      if (!until) return tl::unexpected(until.error());
      until_ = *until;
    }
    if (!options_.settle.empty()) {
      const auto limit = ParseDuration(options_.settle);
      if (!limit) return tl::unexpected(limit.error());
      settle_limit_ = std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * limit->value()));
    }
    read_.emplace(FullOf(states_), session_, frame_);
    plan_.measurements = options_.measurements;
    auto settings = DriverSettings(options_.settings);
    if (!settings) return Propagate(std::move(settings));
    MeterRequest request = options_.request;
    request.settings = *std::move(settings);
    auto opened = ReadingSource::Open(
        {options_.session, options_.typed, std::move(request), session_.meters, "--typed"},
        !console_.json() || options_.typed, console_);
    if (!opened) return Propagate(std::move(opened));
    source_ = *std::move(opened);
    const bool tape = source_.meter() != nullptr && source_.meter()->IsReplay();
    if (tape && plan_.measurements == 0) plan_.measurements = 1;
    if (source_.meter() == nullptr && frame_.meter.empty() && session_.meters.size() == 1) {
      frame_.meter = session_.meters.front().name;
    }
    return Drive();
  }

  // Once all else is known to be right: what is sent moves a fixture.
  Result<void> Drive() {
    if (options_.sacn.empty()) return {};
    auto driven = DrivenFixture::Open(options_.sacn, options_.map, options_.session,
                                      SweepOrder(states_, Order()));
    if (!driven) return Propagate(std::move(driven));
    driven_ = *std::move(driven);
    console_.Note("sACN universe " + std::to_string(driven_->universe()) + " to " +
                  driven_->address() + ", priority " + std::to_string(driven_->map().priority) +
                  "; Ctrl-C lets the fixture go.");
    return {};
  }

  [[nodiscard]] std::optional<std::uint64_t> Order() const {
    if (options_.in_order) return std::nullopt;
    return options_.seed;
  }

  Result<void> CheckPlace() const {
    const LightKind kind = FindLight(session_, frame_.light)->kind;
    const bool anywhere = kind == LightKind::kDirectional || kind == LightKind::kDome;
    if (frame_.distance || anywhere) return {};
    return WrongUsage("--distance", "say where the meter stands, for example 1m; it stays there");
  }

  // The order is the same at every start, so that what the journal holds is not read again.
  Result<void> TakeAll() {
    const std::vector<FixtureState> order = SweepOrder(states_, Order());
    const std::vector<FixtureState> left = NotYetRead(order, session_, frame_);
    skipped_ = order.size() - left.size();
    if (skipped_ > 0) {
      console_.Note(std::to_string(skipped_) + " of " + std::to_string(order.size()) +
                    " readings are in the journal already.");
    }
    left_ = left.size();
    for (std::size_t i = 0; i < left.size();) {
      const auto took =
          Take(left[i], std::to_string(skipped_ + i + 1) + " of " + std::to_string(order.size()));
      if (!took) return tl::unexpected(took.error());
      if (*took == Took::kEnd) return {};
      if (*took == Took::kBack) {
        --i, ++left_;
      } else {
        ++i, --left_;
      }
    }
    return {};
  }

  // The ends first; then wherever the lamp is least sure, until it is sure enough everywhere.
  Result<void> TakeUntil() {
    const std::vector<FixtureState> ends = EndsOf(states_);
    std::vector<FixtureState> candidates = NotYetRead(states_, session_, frame_);
    skipped_ = states_.size() - candidates.size();
    // False: it ends here. What was taken back is to be read again.
    const auto take = [&](FixtureState state, const std::string& why) -> Result<bool> {
      const auto took = Take(state, why);
      if (!took) return tl::unexpected(took.error());
      const auto same = [&](const FixtureState& one) { return SameState(one, taken_back_); };
      if (*took == Took::kBack && std::ranges::none_of(candidates, same)) {
        candidates.push_back(taken_back_);
      }
      if (*took == Took::kReading) {
        std::erase_if(candidates, [&](const FixtureState& one) { return SameState(one, state); });
      }
      return *took != Took::kEnd;
    };
    const auto unread = [&](const FixtureState& end) {
      return std::ranges::any_of(candidates,
                                 [&](const FixtureState& one) { return SameState(one, end); });
    };
    for (auto end = std::ranges::find_if(ends, unread); end != ends.end();
         end = std::ranges::find_if(ends, unread)) {
      const auto more = take(*end, "an end");
      if (!more) return tl::unexpected(more.error());
      if (!*more) return {};
    }
    std::size_t others = ends.size();
    while (!candidates.empty()) {
      if (others >= kBackToFull) {
        const auto more = take(FullOf(states_), "back to full");
        if (!more) return tl::unexpected(more.error());
        if (!*more) return {};
        others = 0;
      }
      const auto worst = LeastSure(candidates);
      if (!worst) return tl::unexpected(worst.error());
      worst_ = worst->half_width;
      if (worst->half_width <= until_) break;
      ++others;
      const auto more = take(candidates[worst->index], worst->interval + " until it is read");
      if (!more) return tl::unexpected(more.error());
      if (!*more) return {};
    }
    left_ = 0;
    return {};
  }

  // Of the states that were not read, the one whose light is known least.
  struct Unsure {
    std::size_t index = 0;
    double half_width = HUGE_VAL;
    std::string interval{};
  };
  Result<Unsure> LeastSure(const std::vector<FixtureState>& candidates) {
    Console muted({.json = false,
                   .quiet = true,
                   .verbose = false,
                   .strict = false,
                   .allow_outside = console_.allows_outside(),
                   .muted = true});
    const auto fitted = CalibrateAloud(options_.session, CalibrationSettings{}, muted);
    if (!fitted) return tl::unexpected(fitted.error());
    const auto light = std::ranges::find(fitted->lights.lights, frame_.light, &FittedLight::name);
    if (light == fitted->lights.lights.end()) return Unsure{};
    StateAnswers answers(*light);
    Unsure worst{0, -1.0};
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const auto answer = answers.At(candidates[i]);
      const double half = answer ? answer->relative.u95 / answer->relative.value : HUGE_VAL;
      if (half > worst.half_width) {
        worst = {i, half, answer ? RelativeText(answer->relative) : "unknown"};
      }
    }
    return worst;
  }

  // A reading; the end: the person stops here, or the tape does; the last one was taken back;
  // nothing.
  enum class Took : std::uint8_t { kReading, kEnd, kBack, kNothing };

  // One state: set, read, journalled.
  Result<Took> Take(const FixtureState& state, const std::string& progress) {
    if (!source_.HasMore() || InterruptGuard::StopRequest().Requested()) return Took::kEnd;
    const bool tape = source_.meter() != nullptr && source_.meter()->IsReplay();
    const std::string set = "[" + progress + "] set " + StateText(state);
    if (driven_) {
      console_.Note(set);
      const auto still = SetAndWait(state);
      if (!still) return tl::unexpected(still.error());
      if (!*still) return Took::kEnd;
    } else if (tape) {
      console_.Note(set);
    } else if (source_.meter() != nullptr) {
      if (!Ask(set + ", press Enter. ")) return Took::kEnd;
      source_.meter()->DropBacklog();
    } else {
      console_.Note(set + ".");
    }
    Reading frame = frame_;
    frame.state = state;
    Took took = Took::kReading;
    const bool by_hand = source_.meter() == nullptr;
    auto taken = by_hand ? TakeTyped(frame, took) : source_.Take(frame, plan_, console_);
    if (!taken) return Propagate(std::move(taken));
    if (took != Took::kReading) return took;
    if (driven_) {
      if (auto heard = driven_->Trouble(); !heard) return Propagate(std::move(heard));
    }
    if (auto kept = AppendToJournal(JournalPath(options_.session), taken->reading); !kept) {
      return tl::unexpected(std::move(kept).error());
    }
    ++taken_;
    console_.Print(SayReading(*taken));
    std::fflush(stdout);
    if (!by_hand) Keep(taken->reading);
    if (taken->reading.illuminance) before_lx_ = taken->reading.illuminance->value();
    if (taken->summary.count > 2) {
      repeatability_ =
          std::clamp(taken->summary.spread_relative, kLeastRepeatability, kMostRepeatability);
    }
    if (taken->reading.illuminance) read_->Add(taken->reading, doubted_);
    mine_.push_back(taken->reading);
    return Took::kReading;
  }

  // What is no light of that state, most likely: asked where somebody can answer, else said. True:
  // it is kept.
  bool Keep(const Reading& reading) {
    const bool typed = source_.meter() == nullptr && reading.illuminance;
    const std::string doubt =
        typed ? read_->DoubtAbout(reading.state, reading.illuminance->value()) : "";
    doubted_ = !doubt.empty();
    if (doubted_ && CanAsk()) {
      const auto keep =
          Ask("Is that right? " + doubt + ".\nEnter = type it again, k = keep it all the same: ");
      if (!keep || *keep != "k") return false;
    }
    if (const auto change = read_->AtFull(reading, UndoLine())) {
      console_.Warn(*change);
    } else if (doubted_ && !CanAsk()) {
      console_.Warn(
          {"state_doubted", StateText(reading.state),
           RoundedText(reading.illuminance->value(), 4) + " lx is hardly its light: " + doubt +
               "; if it was mistyped, take it back (" + UndoLine() + ") and sweep again"});
    }
    return true;
  }

  [[nodiscard]] std::string UndoLine() const {
    return "lightcal read -s " + ShellWord(options_.session) + " --light " +
           ShellWord(frame_.light) + " --undo";
  }

  // The last reading of this run counts no more, and its state is to be read again.
  Result<Took> TakeBack() {
    if (mine_.empty()) {
      console_.Note("nothing was read in this run yet");
      return Took::kNothing;
    }
    const auto back = TakeBackThis(options_.session, mine_.back());
    if (!back) return tl::unexpected(back.error());
    console_.Note("took the last reading back: " + SayTakenBack(back->reading));
    taken_back_ = mine_.back().state;
    if (mine_.back().illuminance) read_->TakeBack();
    mine_.pop_back();
    --taken_;
    return Took::kBack;
  }

  // A state's number as it is typed: what was typed, "" where the person stops here.
  Result<TakenReading> TakeTyped(const Reading& frame, Took& took) {
    while (true) {
      const auto typed =
          Ask("What does the meter show? (for example 192, 17.8fc, or 192,2900K; u = take the last "
              "one back, Enter = stop) ");
      took = Took::kEnd;
      if (!typed || typed->empty()) return TakenReading{};
      if (*typed == "u" || *typed == "undo") {
        auto back = TakeBack();
        if (!back) return tl::unexpected(back.error());
        took = *back;
        if (took == Took::kBack) return TakenReading{};
        continue;
      }
      auto taken = source_.TakeTyped(frame, *typed, console_);
      if (!taken) {
        std::fprintf(stderr, "  %s\n", Printable(InOptionWords(taken.error().message)).c_str());
        continue;
      }
      if (!Keep(taken->reading)) continue;
      took = Took::kReading;
      return taken;
    }
  }

  // False: the person stops here.
  Result<bool> SetAndWait(const FixtureState& state) {
    if (auto set = driven_->Set(state); !set) return Propagate(std::move(set));
    if (source_.meter() == nullptr) return true;
    SteadyRule rule;
    rule.change_relative = kStillSigmas * repeatability_;
    rule.before_lx = before_lx_;
    rule.limit = settle_limit_;
    const auto steady = WaitUntilSteady(*source_.meter(), rule);
    if (!steady) return tl::unexpected(steady.error());
    if (!*steady) {
      console_.Warn({"not_settled", StateText(state),
                     "its light still changed by more than " + PercentText(rule.change_relative) +
                         " in half a second when the time to settle was over; read as it was"});
    }
    return !InterruptGuard::StopRequest().Requested();
  }

  void Conclude() {
    const std::string again = left_ > 0 ? "; the same command goes on where this one stopped" : "";
    console_.Note(std::to_string(taken_) + " readings taken, " + std::to_string(left_) + " left" +
                  again + ". See them: lightcal state " + options_.session);
    Node node = {{"light", frame_.light},
                 {"taken", static_cast<int>(taken_)},
                 {"held", static_cast<int>(skipped_)},
                 {"left", static_cast<int>(left_)}};
    if (!options_.in_order) node.Put("seed", static_cast<std::int64_t>(options_.seed));
    if (driven_) {
      node.Put("sacn", Node{{"universe", driven_->universe()},
                            {"address", driven_->address()},
                            {"priority", driven_->map().priority}});
    }
    if (worst_ && std::isfinite(*worst_)) node.Put("u95_relative", *worst_);
    console_.PrintDocument(std::move(node));
  }

  const SweepOptions& options_;
  std::vector<FixtureState> states_;
  Console& console_;
  Session session_;
  Reading frame_;
  MeasuringPlan plan_;
  ReadingSource source_;
  std::optional<DrivenFixture> driven_;
  std::chrono::milliseconds settle_limit_ = SteadyRule{}.limit;
  double repeatability_ = kUnknownRepeatability;
  std::optional<double> before_lx_;
  double until_ = 0.0;
  std::optional<double> worst_;
  std::optional<SweepReadings> read_;
  bool doubted_ = false;       // the last reading, and kept
  std::vector<Reading> mine_;  // of this run, those that count
  FixtureState taken_back_;    // the state whose reading was taken back last
  std::size_t taken_ = 0, skipped_ = 0, left_ = 0;
};

}  // namespace

Result<void> RunSweep(const SweepOptions& options, Console& console) {
  auto states = StatesOver(options.over);
  if (!states) return Propagate(std::move(states));
  return Sweep(options, *std::move(states), console).Run();
}

}  // namespace lightcal::app
