// SPDX-License-Identifier: Apache-2.0
// How long calibrations by several profiles take, measured side by side, in processor time.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/tradeoff/outcome.h"

namespace lightcal::tradeoff {

struct TimingRules {
  int least_runs = 7;  // of each profile; three, where more take five times `seconds`
  int most_runs = 61;
  double seconds = 8.0;  // by the clock, for all profiles together, beyond the least runs
};

struct Watch {
  std::function<bool()> stopped = [] { return false; };
  std::function<void(double)> progress = [](double /*share*/) {};  // of one measurement, 0 to 1
};

// Processor seconds of one profile's runs. `median` of the whole is the sum of the stages' medians,
// which is what profiles are ranked by; low and high are the quartiles of whole runs.
struct RunTimes {
  int runs = 0;
  StageSeconds median{}, stage_low{}, stage_high{};  // of each stage, with its quartiles
  double total = 0.0, least = 0.0, low = 0.0, high = 0.0;
};

struct Measured {
  AccuracyProfile profile;
  std::vector<LightFigures> lights;
  std::optional<Error> refused;  // this profile gives no answer for this session
  RunTimes times;
};

// Whether profile i need not be run again, by the first runs of the first profile and of its own.
using Settled = std::function<bool(std::size_t i, const Outcome& first, const Outcome& own)>;

// Runs the profiles in turn, A B C A B C ..., so that what else the machine does meets them alike.
// One that is settled has the first profile's times.
// Fails: interrupted, and as the first profile where that gives no answer.
[[nodiscard]] Result<std::vector<Measured>> MeasureInTurn(const Runner& run,
                                                          std::span<const AccuracyProfile> profiles,
                                                          const TimingRules& rules,
                                                          const Watch& watch,
                                                          const Settled& settled = {});

// Whether the quartiles of two profiles' runs overlap.
[[nodiscard]] bool TimesOverlap(const RunTimes& a, const RunTimes& b);

// Whether their medians differ by more than three standard errors (of normal runs, by the
// quartiles); of the whole, or of one stage.
[[nodiscard]] bool TimesDiffer(const RunTimes& a, const RunTimes& b);
[[nodiscard]] bool TimesDiffer(const RunTimes& a, const RunTimes& b, Stage stage);

}  // namespace lightcal::tradeoff
