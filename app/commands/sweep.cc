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
#include "guide/driven_fixture.h"
#include "guide/shell_word.h"
#include "guide/sweep_plan.h"
#include "input_files.h"
#include "interrupt.h"
#include "lightcal/core/interval_text.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/fit/states/state_answer.h"
#include "lightcal/records/journal.h"
#include "lightcal/records/session_codec.h"
#include "lightcal/records/session_reader.h"
#include "read_options.h"
#include "reading_source.h"
#include "session_names.h"
#include "terminal.h"

namespace lightcal::app {
namespace {

// A lamp that gives this much less or more when it comes back to full is not yet steady.
constexpr double kDrift = 0.02;
// No warming up changes ln of its light so much: another number was typed, or the lamp is not back.
constexpr double kNoDrift = 0.4;
// Light that changes by less than this many of the meter's repeatabilities stands still: six looks'
// least-squares line alone changes by 1.2 of them, 1 sigma.
constexpr double kStillSigmas = 2.5;
constexpr double kUnknownRepeatability = 0.004, kLeastRepeatability = 0.001,
                 kMostRepeatability = 0.01;

struct SweepOptions {
  std::string session, light, distance, meter, until, sacn, map, settle;
  std::vector<std::string> over, settings;
  MeterRequest request;
  int measurements = 0;
  std::uint64_t seed = 1;
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
    std::size_t others = ends.size();
    while (!candidates.empty()) {
      if (others >= kBackToFull) {
        const auto more = Take(FullOf(states_), "back to full");
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

  // One state: set, read, journalled. False: the person stops here, or the tape is at its end.
  Result<bool> Take(const FixtureState& state, const std::string& progress) {
    if (!source_.HasMore() || InterruptGuard::StopRequest().Requested()) return false;
    const bool tape = source_.meter() != nullptr && source_.meter()->IsReplay();
    const std::string set = "[" + progress + "] set " + StateText(state);
    if (driven_) {
      console_.Note(set);
      const auto still = SetAndWait(state);
      if (!still) return tl::unexpected(still.error());
      if (!*still) return false;
    } else if (tape) {
      console_.Note(set);
    } else if (source_.meter() != nullptr) {
      if (!Ask(set + ", press Enter. ")) return false;
      source_.meter()->DropBacklog();
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
    if (driven_) {
      if (auto heard = driven_->Trouble(); !heard) return Propagate(std::move(heard));
    }
    if (auto kept = AppendToJournal(JournalPath(options_.session), taken->reading); !kept) {
      return tl::unexpected(std::move(kept).error());
    }
    ++taken_;
    console_.Print(SayReading(*taken));
    std::fflush(stdout);
    if (taken->reading.illuminance) before_lx_ = taken->reading.illuminance->value();
    if (taken->summary.count > 2) {
      repeatability_ =
          std::clamp(taken->summary.spread_relative, kLeastRepeatability, kMostRepeatability);
    }
    WatchDrift(taken->reading);
    return true;
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

  void WatchDrift(const Reading& reading) {
    if (!reading.illuminance || !SameState(reading.state, FullOf(states_))) return;
    const double now = reading.illuminance->value();
    const bool another = first_full_ && std::abs(std::log(now / *first_full_)) > kNoDrift;
    if (another) {
      console_.Warn({"return_disagrees", frame_.light,
                     "back at " + StateText(reading.state) + " it read " + RoundedText(now, 4) +
                         " lx where it had read " + RoundedText(*first_full_, 4) +
                         ": if the number is wrong, take it back (lightcal read -s " +
                         ShellWord(options_.session) + " --undo) and sweep again"});
    } else if (first_full_ && std::abs(now / *first_full_ - 1.0) > kDrift) {
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
  auto* in_order = parser.add_flag("--in-order", o.in_order, "As written, not shuffled");
  parser.add_option("--seed", o.seed, "Of the order, which a sweep that goes on must keep [1]")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 53))
      ->excludes(in_order);
  auto* sacn = parser.add_option(
      "--sacn", o.sacn, "Set the states by sACN: UNIVERSE@HOST, or UNIVERSE to multicast it");
  auto* map = parser.add_option("--map", o.map, "Which slots move which control: map.toml");
  sacn->needs(map);
  map->needs(sacn);
  parser.add_option("--settle", o.settle, "Of what --sacn sets: wait at most this long [15s]")
      ->needs(sacn);
  parser.add_option("-n", o.measurements, "Measurements to take the median of")
      ->check(CLI::Range(1, 1000));
  auto* device = parser.add_option("--device", o.request.device, "A meter's id or driver's name");
  auto* replay =
      parser.add_option("--replay", o.request.replay_file, "Play a tape instead of a meter");
  replay->excludes(device);
  parser.add_option("--set", o.settings, "Of the meter's driver: name=value; repeatable")
      ->allow_extra_args(false);
  parser.add_option("--record", o.request.record_file, "Write what the meter said to a tape")
      ->excludes(replay);
  parser.add_flag("--typed", o.typed, "You type what the meter shows, whatever is plugged in")
      ->excludes(device)
      ->excludes(replay);
  return [options](Console& console) { return RunSweep(*options, console); };
}

}  // namespace lightcal::app
