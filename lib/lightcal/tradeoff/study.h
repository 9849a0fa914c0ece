// SPDX-License-Identifier: Apache-2.0
// What each knob costs in accuracy and saves in time on one session, and the setting to take.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/tradeoff/knobs.h"
#include "lightcal/tradeoff/outcome.h"
#include "lightcal/tradeoff/timing.h"

namespace lightcal::tradeoff {

struct Question {
  double tolerance_relative = 0.01;
  std::optional<double> budget_s;
  std::vector<std::string> knobs;  // those to move; empty = all
  TimingRules alone{};             // each knob alone
  TimingRules together{.least_runs = 7, .most_runs = 101, .seconds = 6.0};  // combinations
  // What seems worth taking beside the usual profile, once more.
  TimingRules sure{.least_runs = 9, .most_runs = 101, .seconds = 2.0};
};

// An error against the session's own standard uncertainty u: below u/10 nobody will ever see it,
// up to u/3 it adds at most 6 % to the interval.
enum class Verdict : std::uint8_t { kFree, kSafe, kCosts, kNoAnswer };
inline constexpr std::array<std::string_view, 4> kVerdictWords = {"free", "safe", "costs accuracy",
                                                                  "no answer"};
inline constexpr double kFreeShare = 0.1;
inline constexpr double kSafeShare = 1.0 / 3.0;
// Of the usual profile's time: who saves less has nothing to trade.
inline constexpr double kLeastSaved = 0.10;

struct Setting {
  std::vector<std::size_t> levels;  // of each knob of Knobs()
  Measured measured;
  SettingError error;  // against the reference
  Verdict verdict = Verdict::kNoAnswer;
  // Of the light whose standard uncertainty u changes most: how much, relative to u itself.
  double u_change = 0.0;
  // The usual profile's, run in turns with this one: a machine that is busy at times is so for
  // both. None of the usual one itself.
  RunTimes usual{};

  // By the medians; 1 where the times do not differ (timing.h).
  [[nodiscard]] double TimesFaster() const;
};

// One knob moved from the usual profile.
struct SweepRow {
  std::size_t knob = 0;
  Setting setting;
  bool in_play = false;     // it changes an answer or interval, or the time beyond the runs' spread
  double saves_s = 0.0;     // in the knob's stage; 0 where the runs overlap there
  double times_faster = 1;  // the whole run, by that, than the usual profile
};

struct Study {
  Measured reference;            // the strictest profile
  double self_difference = 0.0;  // between it and its check, relative
  Setting usual;
  std::vector<SweepRow> rows;
  std::vector<Setting> combinations;  // the most promising, measured; cheapest first
  Setting recommended;                // the usual one where nothing saves kLeastSaved
  // Of the usual profile's time, by runs of both in turn; see recommend.h.
  double saved_share = 0.0;
  // What limited the choice: min(tolerance, u/3).
  double allowed_relative = 0.0;
  bool meter_limits = false;  // u/3 is below the tolerance: a finer setting buys nothing
};

// Refused: no_reference (the strictest profile and its check differ by more than a hundredth of the
// tolerance: then there is nothing to measure against), no_setting (none meets the tolerance within
// the budget; the nearest is named, and what limits it). Wrong usage: an unknown knob. Fails:
// interrupted, and as the runner.
[[nodiscard]] Result<Study> StudyTradeoff(const Runner& run, const Question& question,
                                          const Watch& watch);

// Of the knobs moved, those of which no level changes an answer, an interval or the time.
[[nodiscard]] std::vector<std::string_view> KnobsNotInPlay(const Study& study);

// Every setting measured: the usual one, each row's, the combinations. They live in `study`.
[[nodiscard]] std::vector<const Setting*> AllSettings(const Study& study);

// Settings that no other beats in both time and error, cheapest first: indices into AllSettings.
[[nodiscard]] std::vector<std::size_t> ParetoOf(const Study& study);

// "effects none, solver closed_form": what differs from the usual profile; "as usual" where
// nothing.
[[nodiscard]] std::string NameOf(const std::vector<std::size_t>& levels);

}  // namespace lightcal::tradeoff
