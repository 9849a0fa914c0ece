// SPDX-License-Identifier: Apache-2.0
// Which of a study's settings to take.
#pragma once

#include <vector>

#include "lightcal/tradeoff/study.h"

namespace lightcal::tradeoff {

// How each figure of a setting differs from the reference, signed, in the order of DifferencesFrom.
[[nodiscard]] std::vector<double> SignedDifferences(const Study& study, const Measured& measured);

// What of the usual profile's time a setting does without; 0 where the times do not differ
// (timing.h).
[[nodiscard]] double SavedShare(const RunTimes& usual, const RunTimes& own);

// Measures `candidate` in turns with the usual setting and recommends it where it saves kLeastSaved
// or the usual one is no choice (`usual_holds`), else the usual one. Fails: interrupted.
[[nodiscard]] Result<void> RecommendIfItSaves(const Runner& run, const TimingRules& rules,
                                              const Watch& watch, const Setting& candidate,
                                              bool usual_holds, Study& study);

// Fills what a study recommends: the cheapest setting whose differences all lie within `limits`,
// where it saves enough, the strictest where none does (an interval that only draws tell); under a
// budget the most accurate within it. Refused: no_setting (under a budget, or where not every knob
// may move). Fails: interrupted.
[[nodiscard]] Result<void> Recommend(const Runner& run, const Question& question,
                                     const std::vector<double>& limits, const Watch& watch,
                                     Study& study);

}  // namespace lightcal::tradeoff
