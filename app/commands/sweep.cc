// SPDX-License-Identifier: Apache-2.0
// lightcal sweep: a fixture's states, one after another, into the journal.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include "calibration_options.h"
#include "commands.h"
#include "guide/sweep_plan.h"
#include "input_files.h"
#include "interrupt.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/fit/states/state_answer.h"
#include "lightcal/records/journal.h"
#include "lightcal/records/session_codec.h"
#include "lightcal/records/session_reader.h"
#include "reading_source.h"
#include "session_names.h"
#include "terminal.h"

namespace lightcal::app {
namespace {

// A lamp that gives this much less or more when it comes back to full is not yet steady.
constexpr double kDrift = 0.02;

struct SweepOptions {
  std::string session, light, distance, tilt, meter, until;
  std::vector<std::string> over;
  MeterRequest request;
  int measurements = 0;
  bool typed = false;
  bool in_order = false;
};

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
    frame_.light = options_.light;
    if (frame_.light.empty() && session_.lights.size() == 1) {
      frame_.light = session_.lights.front().name;
    }
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
    plan_.measurements = options_.measurements;
    auto opened = ReadingSource::Open({options_.session, options_.typed, options_.request},
                                      !console_.json() || options_.typed, console_);
    if (!opened) return Propagate(std::move(opened));
    source_ = *std::move(opened);
    const bool tape = source_.meter() != nullptr && source_.meter()->IsReplay();
    if (tape && plan_.measurements == 0) plan_.measurements = 1;
    if (source_.meter() == nullptr && frame_.meter.empty() && session_.meters.size() == 1) {
      frame_.meter = session_.meters.front().name;
    }
    return {};
  }

  Result<void> CheckPlace() const {
    const LightKind kind = FindLight(session_, frame_.light)->kind;
    const bool anywhere = kind == LightKind::kDirectional || kind == LightKind::kDome;
    if (frame_.distance || anywhere) return {};
    return WrongUsage("--distance", "say where the meter stands, for example 1m; it stays there");
  }

  // The order is the same at every start, so that what the journal holds is not read again.
  Result<void> TakeAll() {
    const std::vector<FixtureState> order = SweepOrder(states_, options_.in_order);
    const std::vector<FixtureState> left = NotYetRead(order, session_, frame_);
    skipped_ = order.size() - left.size();
    if (skipped_ > 0) {
      console_.Note(std::to_string(skipped_) + " of " + std::to_string(order.size()) +
                    " readings are in the journal already.");
    }
    left_ = left.size();
    for (std::size_t i = 0; i < left.size(); ++i) {
      const auto more =
          Take(left[i], std::to_string(skipped_ + i + 1) + " of " + std::to_string(order.size()));
      if (!more) return tl::unexpected(more.error());
      if (!*more) return {};
      --left_;
    }
    return {};
  }

  // The ends first; then wherever the lamp is least sure, until it is sure enough everywhere.
  Result<void> TakeUntil() {
    const std::vector<FixtureState> ends = EndsOf(states_);
    std::vector<FixtureState> candidates = NotYetRead(states_, session_, frame_);
    skipped_ = states_.size() - candidates.size();
    const auto take = [&](FixtureState state,
                          const std::string& why) -> Result<bool> {  // erased below
      auto more = Take(state, why);
      std::erase_if(candidates, [&](const FixtureState& one) { return SameState(one, state); });
      return more;
    };
    for (const FixtureState& end : ends) {
      const auto same = [&](const FixtureState& one) { return SameState(one, end); };
      if (std::ranges::none_of(candidates, same)) continue;
      const auto more = take(end, "an end");
      if (!more) return tl::unexpected(more.error());
      if (!*more) return {};
    }
    while (!candidates.empty()) {
      const auto worst = LeastSure(candidates);
      if (!worst) return tl::unexpected(worst.error());
      worst_ = worst->second;
      if (worst->second <= until_) break;
      const auto more =
          take(candidates[worst->first], "± " + PercentText(worst->second) + " until it is read");
      if (!more) return tl::unexpected(more.error());
      if (!*more) return {};
    }
    left_ = 0;
    return {};
  }

  // Of the states that were not read, the one whose light is known least; its half width.
  Result<std::pair<std::size_t, double>> LeastSure(const std::vector<FixtureState>& candidates) {
    Console muted({.json = false,
                   .quiet = true,
                   .verbose = false,
                   .strict = false,
                   .allow_outside = console_.allows_outside(),
                   .muted = true});
    const auto fitted = CalibrateAloud(options_.session, CalibrationSettings{}, muted);
    if (!fitted) return tl::unexpected(fitted.error());
    const auto light = std::ranges::find(fitted->lights.lights, frame_.light, &FittedLight::name);
    if (light == fitted->lights.lights.end()) return std::pair<std::size_t, double>{0, HUGE_VAL};
    std::pair<std::size_t, double> worst{0, -1.0};
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const auto answer = AnswerState(*light, candidates[i]);
      const double half = answer ? answer->relative.u95 / answer->relative.value : HUGE_VAL;
      if (half > worst.second) worst = {i, half};
    }
    return worst;
  }

  // One state: set, read, journalled. False: the person stops here, or the tape is at its end.
  Result<bool> Take(const FixtureState& state, const std::string& progress) {
    if (!source_.HasMore() || InterruptGuard::StopRequest().Requested()) return false;
    const bool tape = source_.meter() != nullptr && source_.meter()->IsReplay();
    const std::string set = "[" + progress + "] set " + StateText(state);
    if (tape) {
      console_.Note(set);
    } else if (source_.meter() != nullptr) {
      if (!Ask(set + ", press Enter. ")) return false;
    } else {
      console_.Note(set + ".");
    }
    Reading frame = frame_;
    frame.state = state;
    auto taken = source_.Take(frame, plan_, console_);
    if (!taken) {
      const bool no_more = source_.meter() == nullptr && taken.error().code == "no_device";
      if (no_more) return false;
      return Propagate(std::move(taken));
    }
    if (auto kept = AppendToJournal(JournalPath(options_.session), taken->reading); !kept) {
      return tl::unexpected(std::move(kept).error());
    }
    ++taken_;
    console_.Print(SayReading(*taken));
    std::fflush(stdout);
    WatchDrift(taken->reading);
    return true;
  }

  void WatchDrift(const Reading& reading) {
    if (!reading.illuminance || !SameState(reading.state, FullOf(states_))) return;
    const double now = reading.illuminance->value();
    if (first_full_ && std::abs(now / *first_full_ - 1.0) > kDrift) {
      console_.Warn({"drift", frame_.light,
                     "back at " + StateText(reading.state) + " it gives " +
                         PercentText(now / *first_full_ - 1.0) +
                         " of a change: let it warm up, and sweep again"});
    }
    if (!first_full_ && now > 0.0) first_full_ = now;
  }

  void Conclude() {
    const std::string again = left_ > 0 ? "; the same command goes on where this one stopped" : "";
    console_.Note(std::to_string(taken_) + " readings taken, " + std::to_string(left_) + " left" +
                  again + ". See them: lightcal state " + options_.session);
    Node node = {{"light", frame_.light},
                 {"taken", static_cast<int>(taken_)},
                 {"held", static_cast<int>(skipped_)},
                 {"left", static_cast<int>(left_)}};
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
  double until_ = 0.0;
  std::optional<double> first_full_, worst_;
  std::size_t taken_ = 0, skipped_ = 0, left_ = 0;
};

Result<void> RunSweep(const SweepOptions& options, Console& console) {
  auto states = StatesOver(options.over);
  if (!states) return Propagate(std::move(states));
  return Sweep(options, *std::move(states), console).Run();
}

}  // namespace

Run BuildSweep(CLI::App& parser) {
  auto options = std::make_shared<SweepOptions>();
  SweepOptions& o = *options;
  parser.add_option("-s,--session", o.session, "Session the readings are appended to")->required();
  parser.add_option("--light", o.light, "Name of the lamp [the only one]");
  parser
      .add_option("--over", o.over,
                  "A control and its values: dimmer=100,50,25,12; repeated, every combination")
      ->allow_extra_args(false)
      ->required();
  parser.add_option("--distance", o.distance, "From the lamp to the meter, which stays there: 1m");
  parser.add_option("--meter", o.meter, "The session's [[meter]] that takes the readings");
  parser.add_option("--until", o.until,
                    "Read only until every state is known within this: 3% [all of them]");
  parser.add_flag("--in-order", o.in_order, "As written, not shuffled");
  parser.add_option("-n", o.measurements, "Measurements to take the median of")
      ->check(CLI::Range(1, 1000));
  auto* device = parser.add_option("--device", o.request.device, "A meter's id or driver's name");
  auto* replay =
      parser.add_option("--replay", o.request.replay_file, "Play a tape instead of a meter");
  replay->excludes(device);
  parser.add_flag("--typed", o.typed, "You type what the meter shows, whatever is plugged in")
      ->excludes(device)
      ->excludes(replay);
  return [options](Console& console) { return RunSweep(*options, console); };
}

}  // namespace lightcal::app
