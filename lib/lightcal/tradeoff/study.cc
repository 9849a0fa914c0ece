// SPDX-License-Identifier: Apache-2.0
#include "lightcal/tradeoff/study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "lightcal/core/did_you_mean.h"
#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/tradeoff/combine.h"
#include "lightcal/tradeoff/recommend.h"

namespace lightcal::tradeoff {
namespace {

// How well reference and check agree: a share of the tolerance; of an interval, whose draws tell it
// to 0.3 %, a share of its own width.
constexpr double kReferenceShare = 0.01;
constexpr double kIntervalShare = 0.02;
constexpr TimingRules kOnce{.least_runs = 1, .most_runs = 2, .seconds = 1e-6};
constexpr std::size_t kCombinations = 6;
constexpr double kSeenTime = 0.01;   // of the run: a smaller change of time is none
constexpr double kSeenError = 1e-9;  // relative
constexpr double kSeenShareOfU = 1e-6;

using Levels = std::vector<std::size_t>;

std::string WhereText(const SettingError& error) {
  return std::string(error.quantity) + " of " + error.light;
}

Levels UsualLevels() {
  Levels levels;
  for (const Knob& knob : Knobs()) levels.push_back(knob.usual);
  return levels;
}

AccuracyProfile ProfileOf(const Levels& levels, double tolerance) {
  AccuracyProfile profile;
  profile.tolerance_relative = tolerance;
  for (std::size_t k = 0; k < levels.size(); ++k) Knobs()[k].set(profile, levels[k]);
  return profile;
}

Result<std::vector<bool>> KnobsToMove(const std::vector<std::string>& names) {
  std::vector<bool> moved(Knobs().size(), names.empty());
  std::vector<std::string_view> known;
  for (const Knob& knob : Knobs()) known.push_back(knob.name);
  for (const std::string& name : names) {
    const auto found = std::ranges::find(known, name);
    if (found == known.end()) {
      return WrongUsage(
          "{study.knobs} " + name,
          "is no knob" + DidYouMean(name, std::vector<Knob>(Knobs().begin(), Knobs().end())));
    }
    moved[static_cast<std::size_t>(found - known.begin())] = true;
  }
  return moved;
}

// The largest change of an interval's width, relative to itself; signed.
double LargestChangeOfU(const std::vector<Difference>& differences) {
  double largest = 0.0;
  for (const Difference& d : differences) {
    const double change = d.quantity == kInterval ? d.relative / d.sd : 0.0;
    if (std::abs(change) > std::abs(largest)) largest = change;
  }
  return largest;
}

Result<void> CheckReference(const Measured& reference, const Measured& check, double tolerance,
                            Study& study) {
  if (check.refused) return tl::unexpected(*check.refused);
  const auto differences = DifferencesFrom(reference.lights, check.lights);
  if (const double apart = std::abs(LargestChangeOfU(differences)); apart > kIntervalShare) {
    return Refused("no_reference", "tradeoff",
                   "two sets of draws put a 95 % interval at widths " + PercentText(apart) +
                       " apart: its tails are too long to judge settings by; more readings "
                       "shorten them");
  }
  const SettingError apart = ErrorOf(differences);
  study.self_difference = apart.relative;
  if (apart.relative <= kReferenceShare * tolerance) return {};
  return Refused("no_reference", "tradeoff",
                 "the strictest setting and its check, by another solver and other quadrature, "
                 "differ by " +
                     PercentText(apart.relative) + " in the " + WhereText(apart) +
                     ", more than a hundredth of {study.tolerance}: nothing finer than " +
                     PercentText(apart.relative / kReferenceShare) + " can be judged here");
}

// The smallest of tolerance and a third of the figure's own uncertainty.
std::vector<double> LimitsOf(const Study& study, double tolerance, double* least, bool* by_meter) {
  std::vector<double> limits;
  *least = tolerance;
  for (const Difference& d : DifferencesFrom(study.reference.lights, study.reference.lights)) {
    const double by_u = kSafeShare * d.sd;
    if (d.quantity == kInterval) {  // the tolerance is one of values
      limits.push_back(std::max(kSeenError, by_u));
      continue;
    }
    limits.push_back(std::max(kSeenError, std::min(tolerance, by_u)));
    *least = std::min(*least, limits.back());
    if (d.quantity == kStrength && by_u < tolerance) *by_meter = true;
  }
  return limits;
}

void Judge(const Study& study, Setting& setting) {
  if (setting.measured.refused) return;
  const auto differences = DifferencesFrom(study.reference.lights, setting.measured.lights);
  setting.error = ErrorOf(differences);
  setting.u_change = LargestChangeOfU(differences);
  setting.verdict = setting.error.over_u < kFreeShare    ? Verdict::kFree
                    : setting.error.over_u <= kSafeShare ? Verdict::kSafe
                                                         : Verdict::kCosts;
}

// In the knob's own stage: what a noisy machine does in the others is none of its doing.
double SavedSeconds(const Study& study, const SweepRow& row) {
  const RunTimes& usual = study.usual.measured.times;
  const RunTimes& own = row.setting.measured.times;
  const Stage stage = Knobs()[row.knob].stage;
  const auto i = static_cast<std::size_t>(stage);
  const double saved = usual.median[i] - own.median[i];
  const bool apart = TimesDiffer(usual, own, stage) && std::abs(saved) > kSeenTime * usual.total;
  return apart ? saved : 0.0;
}

bool Moves(const std::vector<LightFigures>& usual, const std::vector<LightFigures>& own) {
  const SettingError moved = ErrorOf(DifferencesFrom(usual, own));
  return moved.relative > kSeenError || moved.over_u > kSeenShareOfU;
}

// Neither an answer nor, in a stage of hardly any time with and without, the time: more runs of it
// would show no more.
bool ChangesNothing(Stage stage, const Outcome& usual, const Outcome& own) {
  const auto is_hardly_any = [stage](const StageSeconds& seconds) {
    const double whole = std::accumulate(seconds.begin(), seconds.end(), 0.0);
    return seconds[static_cast<std::size_t>(stage)] <= kSeenTime * whole;
  };
  return is_hardly_any(usual.seconds) && is_hardly_any(own.seconds) &&
         !Moves(usual.lights, own.lights);
}

void FillRow(const Study& study, SweepRow& row) {
  Judge(study, row.setting);
  if (row.setting.measured.refused) {
    row.in_play = true;
    return;
  }
  row.saves_s = SavedSeconds(study, row);
  row.in_play =
      row.saves_s != 0.0 || Moves(study.usual.measured.lights, row.setting.measured.lights);
  const double usual = study.usual.measured.times.total;
  row.times_faster = usual / (usual - row.saves_s);
}

CombineInput InputOf(const Study& study, const std::vector<double>& limits, double budget) {
  CombineInput input;
  input.usual = study.usual.levels;
  input.seconds = study.usual.measured.times.total;
  input.differences = SignedDifferences(study, study.usual.measured);
  input.limits = limits;
  input.budget = budget;
  input.changes.resize(Knobs().size());
  for (const SweepRow& row : study.rows) {
    const bool finer = row.setting.error.relative < study.usual.error.relative;
    if (row.setting.measured.refused || (!(row.saves_s > 0.0) && !finer)) continue;
    Change change{row.setting.levels[row.knob], -row.saves_s,
                  SignedDifferences(study, row.setting.measured)};
    for (std::size_t i = 0; i < change.differences.size(); ++i) {
      change.differences[i] -= input.differences[i];
    }
    input.changes[row.knob].push_back(std::move(change));
  }
  return input;
}

Result<void> MeasureCombinations(const Runner& run, const Question& question,
                                 const std::vector<double>& limits, const Watch& watch,
                                 Study& study) {
  std::vector<Levels> wanted;
  const CombineInput input = InputOf(study, limits, question.budget_s.value_or(0.0));
  for (Foretold& one : BestCombinations(input, kCombinations)) {
    wanted.push_back(std::move(one.levels));
  }
  std::vector<AccuracyProfile> profiles = {study.usual.measured.profile};
  for (const Levels& levels : wanted) {
    profiles.push_back(ProfileOf(levels, question.tolerance_relative));
  }
  auto measured = MeasureInTurn(run, profiles, question.together, watch);
  if (!measured) return Propagate(std::move(measured));
  study.usual.measured = std::move(measured->front());
  const RunTimes usual = study.usual.measured.times;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i] == study.usual.levels) continue;
    Setting setting{wanted[i], std::move((*measured)[i + 1]), {}, Verdict::kNoAnswer, 0.0, usual};
    Judge(study, setting);
    study.combinations.push_back(std::move(setting));
  }
  std::ranges::sort(study.combinations, {},
                    [](const Setting& s) { return s.measured.times.total; });
  return {};
}

}  // namespace

std::vector<std::string_view> KnobsNotInPlay(const Study& study) {
  std::vector<std::string_view> names;
  for (std::size_t k = 0; k < Knobs().size(); ++k) {
    const auto of_knob = [k](const SweepRow& row) { return row.knob == k; };
    const auto in_play = [k](const SweepRow& row) { return row.knob == k && row.in_play; };
    if (std::ranges::any_of(study.rows, of_knob) && std::ranges::none_of(study.rows, in_play)) {
      names.push_back(Knobs()[k].name);
    }
  }
  return names;
}

std::vector<const Setting*> AllSettings(const Study& study) {
  std::vector<const Setting*> all = {&study.usual};
  for (const SweepRow& row : study.rows) all.push_back(&row.setting);
  for (const Setting& one : study.combinations) all.push_back(&one);
  return all;
}

double Setting::TimesFaster() const {
  const RunTimes& own = measured.times;
  return usual.runs > 0 && TimesDiffer(usual, own) ? usual.total / own.total : 1.0;
}

std::string NameOf(const Levels& levels) {
  std::string text;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const Knob& knob = Knobs()[k];
    if (levels[k] == knob.usual) continue;
    text += (text.empty() ? "" : ", ") + std::string(knob.name) + " " +
            std::string(knob.levels[levels[k]]);
  }
  return text.empty() ? "as usual" : text;
}

Result<Study> StudyTradeoff(const Runner& run, const Question& question, const Watch& watch) {
  const auto moved = KnobsToMove(question.knobs);
  if (!moved) return tl::unexpected(moved.error());
  const double tolerance = question.tolerance_relative;
  Study study;
  study.usual.levels = UsualLevels();
  const std::array references = {StrictProfile(tolerance), StrictCheckProfile(tolerance)};
  watch.progress(0.0);  // the strictest settings take seconds
  auto reference = MeasureInTurn(run, references, kOnce, {watch.stopped});
  if (!reference) return Propagate(std::move(reference));
  study.reference = std::move((*reference)[0]);
  if (auto sure = CheckReference(study.reference, (*reference)[1], tolerance, study); !sure) {
    return Propagate(std::move(sure));
  }
  std::vector<AccuracyProfile> profiles = {ProfileOf(study.usual.levels, tolerance)};
  for (std::size_t k = 0; k < Knobs().size(); ++k) {
    for (std::size_t level = 0; (*moved)[k] && level < Knobs()[k].levels.size(); ++level) {
      if (level == Knobs()[k].usual) continue;
      SweepRow row;
      row.knob = k;
      row.setting.levels = study.usual.levels;
      row.setting.levels[k] = level;
      profiles.push_back(ProfileOf(row.setting.levels, tolerance));
      study.rows.push_back(std::move(row));
    }
  }
  const auto settled = [&](std::size_t i, const Outcome& usual, const Outcome& own) {
    return ChangesNothing(Knobs()[study.rows[i - 1].knob].stage, usual, own);
  };
  auto measured = MeasureInTurn(run, profiles, question.alone, watch, settled);
  if (!measured) return Propagate(std::move(measured));
  study.usual.measured = std::move(measured->front());
  Judge(study, study.usual);
  for (std::size_t i = 0; i < study.rows.size(); ++i) {
    study.rows[i].setting.measured = std::move((*measured)[1 + i]);
    study.rows[i].setting.usual = study.usual.measured.times;
    FillRow(study, study.rows[i]);
  }
  const std::vector<double> limits =
      LimitsOf(study, tolerance, &study.allowed_relative, &study.meter_limits);
  if (auto done = MeasureCombinations(run, question, limits, watch, study); !done) {
    return Propagate(std::move(done));
  }
  if (auto chosen = Recommend(run, question, limits, watch, study); !chosen) {
    return Propagate(std::move(chosen));
  }
  return study;
}

std::vector<std::size_t> ParetoOf(const Study& study) {
  const std::vector<const Setting*> all = AllSettings(study);
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return all[i]->measured.refused.has_value(); });
  std::ranges::sort(order, {}, [&](std::size_t i) {
    return std::pair(all[i]->measured.times.total, all[i]->error.relative);
  });
  std::vector<std::size_t> pareto;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (!(all[i]->error.relative < least)) continue;
    least = all[i]->error.relative;
    pareto.push_back(i);
  }
  return pareto;
}

}  // namespace lightcal::tradeoff
