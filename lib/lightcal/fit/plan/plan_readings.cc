// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/plan/plan_readings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/stops.h"
#include "lightcal/fit/plan/instrument_limit.h"
#include "lightcal/fit/plan/one_light.h"
#include "lightcal/fit/plan/reading_candidates.h"
#include "lightcal/fit/plan/reading_trial.h"
#include "lightcal/records/display_step.h"

namespace lightcal {
namespace {

// Readings that help equally but for this: the one that comes first is easier.
constexpr double kAsGood = 0.01;
// A step of a ladder shortens the interval at least so much.
constexpr double kLeastGain = 0.02;

// What is to be small: the interval of the intensity and, of a beam, that of its angle.
double OpenAfter(const PlannedReading& planned) {
  return planned.u95_relative * planned.beam_u95_deg.value_or(1.0);
}

// Half of the interval that is left: in stops, and over the value.
struct Left {
  double relative = 0.0;
  double stops = std::numeric_limits<double>::infinity();
};

// Of an intensity known to so much, 1 sigma, relative.
Left LeftBy(double deviation) { return {std::sinh(kZ95 * deviation), StopsOfSd(deviation)}; }

// ln of how much shorter an interval is afterwards: in stops, as people are told; where one of
// them reaches down to nothing, by its width.
double GainOf(const Left& before, const PlannedReading& after) {
  const bool told = std::isfinite(before.stops) && std::isfinite(after.u95_stops);
  return told ? std::log(before.stops / after.u95_stops)
              : std::log(before.relative / after.u95_relative);
}

class Planner {
 public:
  Planner(Session session, const FitSettings& settings, double reach_m)
      : session_(std::move(session)),
        settings_(settings),
        reach_m_(reach_m),
        like_(fit::LikeTheLast(session_)),
        display_step_lx_(DisplayStepOf(session_, like_)),
        last_digit_lx_(fit::LastDigit(display_step_lx_)),
        coarse_step_lx_(fit::CoarseStep(session_, display_step_lx_)) {}

  void Skip(std::vector<PlannedReading> steps) { skip_ = std::move(steps); }
  void Tell(Progress progress) { progress_ = std::move(progress); }

  // only_angles: off the axis.
  Result<ReadingPlan> Plan(int steps, bool only_angles = false) {
    ReadingPlan plan;
    if (auto begun = Begin(); !begun) return Propagate(std::move(begun));
    plan.u95_relative = U95AsRead();
    if (now_ && plan.u95_relative) {
      plan.u95_stops = fit::StopsLeft(*now_);
      plan.beam_u95_deg = fit::BeamLeft(*now_);
    }
    plan.span = fit::DistanceSpan(session_);
    for (int i = 0; i < steps; ++i) {
      BeginStep(i, steps);
      std::vector<PlannedReading> ranked = Rank(only_angles);
      if (ranked.empty()) break;
      if (i == 0) plan.candidates = ranked;
      plan.steps.push_back(ranked.front());
      if (i + 1 < steps) Take(ranked.front());
    }
    return plan;
  }

  Result<MinutesLadder> Ladder(const LadderWishes& wishes) {
    MinutesLadder ladder;
    ladder.light = Light().name;
    if (auto begun = Begin(); !begun) return Propagate(std::move(begun));
    ladder.u95_relative = U95AsRead();
    ladder.meter_u95_relative = MeterU95Relative(session_);
    std::optional<Left> left;
    if (ladder.u95_relative) {
      ladder.u95_stops = fit::StopsLeft(*now_);
      left = Left{*ladder.u95_relative, ladder.u95_stops};
    }
    double total = 0.0;
    for (int i = 0; i < wishes.steps; ++i) {
      BeginStep(i, wishes.steps);
      std::optional<LadderStep> step = BestStep(left, wishes.minutes);
      if (!step) break;
      if (i + 1 < wishes.steps) Take(step->reading);
      if (step->reading.action != PlannedAction::kLampOff) stands_ = step->reading;
      left = Left{step->reading.u95_relative, step->reading.u95_stops};
      step->total_minutes = total += step->minutes;
      const double meter = ladder.meter_u95_relative;
      step->meter_limits = 2.0 * meter * meter > left->relative * left->relative;
      step->say = SayPlannedReading(step->reading);
      ladder.steps.push_back(*std::move(step));
    }
    return ladder;
  }

 private:
  void BeginStep(int step, int steps) {
    of_step_ = PartOf(progress_, static_cast<double>(step) / steps, (step + 1.0) / steps);
  }
  void TellTried(std::size_t tried, std::size_t of) const {
    if (of_step_) of_step_(static_cast<double>(tried) / static_cast<double>(of));
  }

  [[nodiscard]] const LightDescription& Light() const { return session_.lights.front(); }

  // What is known before any step.
  Result<void> Begin() {
    if (now_) return {};
    auto fitted = FitSession(session_, settings_);
    if (fitted && !fitted->lights.lights.empty()) {
      now_ = std::move(fitted->lights.lights.front());
      for (const SessionReading& row : session_.readings) StandAt(row.reading);
    } else if (IsRead()) {
      return Propagate(std::move(fitted));
    }
    return {};
  }

  [[nodiscard]] bool IsRead() const {
    return std::ranges::any_of(session_.readings,
                               [](const SessionReading& row) { return IsLit(row.reading); });
  }
  // None before any reading.
  [[nodiscard]] std::optional<double> U95AsRead() const {
    return now_ && IsRead() ? RelativeUncertainty(*now_) : std::nullopt;
  }

  // The meter stands where it read last.
  void StandAt(const Reading& reading) {
    if (!IsLit(reading) || reading.meter == kDataSheetMeter) return;
    stands_ =
        PlannedReading{PlannedAction::kRead, reading.distance, reading.position_m, reading.normal};
  }

  // More than any one reading takes off ln of what is left.
  [[nodiscard]] double MostGain(const Left& before) const {
    const std::optional<double> deviation = fit::LeastDeviation(session_, like_);
    if (!deviation) return std::numeric_limits<double>::infinity();
    const Left least = LeftBy(*deviation);
    const double of_relative = std::log(before.relative / least.relative);
    return std::isfinite(before.stops) ? std::max(of_relative, std::log(before.stops / least.stops))
                                       : of_relative;
  }

  [[nodiscard]] std::vector<PlannedReading> Candidates(bool only_angles) const {
    std::vector<PlannedReading> out =
        fit::ReadingCandidates(session_, now_ ? &*now_ : nullptr, reach_m_);
    std::erase_if(out, [&](const PlannedReading& candidate) {
      const bool angle = candidate.action == PlannedAction::kRead && candidate.off_axis;
      return (only_angles && !angle) || IsSkipped(candidate);
    });
    return out;
  }

  // Those that would give an answer, in the order they are listed.
  [[nodiscard]] std::vector<PlannedReading> Judged(bool only_angles) {
    std::vector<PlannedReading> out;
    const std::vector<PlannedReading> candidates = Candidates(only_angles);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      auto trial = Tried(candidates[i]);
      if (trial) trial = Settled(*trial);
      if (trial) out.push_back(std::move(trial->planned));
      TellTried(i + 1, candidates.size());
    }
    return out;
  }

  [[nodiscard]] fit::KnownSoFar Known() const {
    return {session_, settings_, like_, now_ ? &*now_ : nullptr, coarse_step_lx_};
  }

  // What a step's readings came to, each tried once.
  struct Outcome {
    PlannedReading asked;
    std::optional<fit::ReadingTrial> trial;
  };
  using Outcomes = std::vector<Outcome>;
  [[nodiscard]] static const Outcome* Find(const Outcomes& of, const PlannedReading& asked) {
    const auto found = std::ranges::find_if(of, [&](const Outcome& one) {
      return SameStep(one.asked, asked) && one.asked.normal == asked.normal;
    });
    return found == of.end() ? nullptr : &*found;
  }

  [[nodiscard]] std::optional<fit::ReadingTrial> Tried(const PlannedReading& candidate) {
    if (const Outcome* known = Find(tried_, candidate)) return known->trial;
    tried_.push_back({candidate, fit::TryExpected(Known(), candidate)});
    return tried_.back().trial;
  }

  // None where that gives no interval, or no meter could read it.
  [[nodiscard]] std::optional<fit::ReadingTrial> Settled(const fit::ReadingTrial& guessed,
                                                         const fit::WorthAFit& worth = {}) {
    const Outcome* known = Find(settled_, guessed.planned);
    auto trial = known != nullptr ? known->trial : fit::Settle(Known(), guessed, worth);
    if (known == nullptr && !worth) settled_.push_back({guessed.planned, trial});
    const bool answers =
        trial && std::isfinite(trial->planned.u95_relative) && IsReadable(trial->planned);
    return answers ? trial : std::nullopt;
  }

  [[nodiscard]] bool IsSkipped(const PlannedReading& candidate) const {
    return std::ranges::any_of(skip_,
                               [&](const PlannedReading& one) { return SameStep(one, candidate); });
  }

  // Whether the meter's last digit is at most 2 % of what it will show.
  [[nodiscard]] bool IsReadable(const PlannedReading& candidate) const {
    constexpr double kMostOfDigit = 0.02;
    const bool lit = candidate.action == PlannedAction::kRead;
    return !now_ || !lit || last_digit_lx_ <= kMostOfDigit * candidate.expected.value();
  }

  [[nodiscard]] double MinutesOf(const PlannedReading& planned,
                                 const MeasuringMinutes& minutes) const {
    const bool stays = planned.action == PlannedAction::kLampOff ||
                       (stands_ && stands_->distance == planned.distance &&
                        stands_->position_m == planned.position_m);
    const bool card = planned.action == PlannedAction::kShadowCard;
    return (stays ? 0.0 : minutes.move) + (card ? minutes.card : minutes.reading);
  }

  // What takes most off ln of the stops left a minute; before any reading what leaves least. None:
  // nothing is worth taking.
  [[nodiscard]] std::optional<LadderStep> BestStep(const std::optional<Left>& left,
                                                   const MeasuringMinutes& minutes) {
    if (!left) {
      std::vector<PlannedReading> ranked = Rank();
      if (ranked.empty()) return std::nullopt;
      const double took = MinutesOf(ranked.front(), minutes);
      return LadderStep{std::move(ranked.front()), {}, took};
    }
    std::map<double, std::vector<PlannedReading>> by_minutes;
    std::vector<PlannedReading> all = Candidates(false);
    const std::size_t count = all.size();
    for (PlannedReading& one : all) {
      by_minutes[MinutesOf(one, minutes)].push_back(std::move(one));
    }
    std::size_t tried = 0;
    const double most_gain = MostGain(*left);
    std::optional<LadderStep> best;
    for (const auto& [took, candidates] : by_minutes) {
      TellTried(tried, count);
      tried += candidates.size();
      if (most_gain / took <= RateOf(*left, best)) continue;
      best = BestOf(*left, candidates, took, std::move(best));
    }
    return best;
  }

  // Off ln of what is left a minute; 0 where there is no step.
  [[nodiscard]] static double RateOf(const Left& left, const std::optional<LadderStep>& step) {
    return step ? GainOf(left, step->reading) / step->minutes : 0.0;
  }

  // Of those that take so many minutes, and what was found before.
  [[nodiscard]] std::optional<LadderStep> BestOf(const Left& left,
                                                 const std::vector<PlannedReading>& candidates,
                                                 double minutes, std::optional<LadderStep> best) {
    const auto rate = [&](const fit::ReadingTrial& trial, double more = 0.0) {
      const double a_minute = (GainOf(left, trial.planned) + more) / minutes;
      return std::isnan(a_minute) ? -std::numeric_limits<double>::infinity() : a_minute;
    };
    std::vector<fit::ReadingTrial> trials;
    for (const PlannedReading& candidate : candidates) {
      if (auto trial = Tried(candidate)) trials.push_back(*std::move(trial));
    }
    std::ranges::stable_sort(trials,
                             [&](const auto& a, const auto& b) { return rate(a) > rate(b); });
    for (const fit::ReadingTrial& guessed : trials) {
      const double most = RateOf(left, best);
      if (fit::IsNearlySettled(guessed) && rate(guessed, fit::kMostBySettling) <= most) continue;
      const auto may_be_best = [&](double u95_relative, double u95_stops) {
        const double of_stops = std::log(left.stops / u95_stops);  // NaN: both without an end
        return std::isnan(of_stops) ||
               std::max(of_stops, std::log(left.relative / u95_relative)) > most * minutes;
      };
      const std::optional<fit::ReadingTrial> trial = Settled(guessed, may_be_best);
      if (!trial || GainOf(left, trial->planned) < kLeastGain || rate(*trial) <= most) continue;
      best = LadderStep{trial->planned, {}, minutes};
    }
    return best;
  }

  // Best first; those as good as the best keep their order.
  [[nodiscard]] std::vector<PlannedReading> Rank(bool only_angles = false) {
    std::vector<PlannedReading> out = Judged(only_angles);
    if (out.empty()) return out;
    const double least = OpenAfter(*std::ranges::min_element(out, {}, OpenAfter));
    const auto as_good = std::find_if(out.begin(), out.end(), [least](const PlannedReading& r) {
      return OpenAfter(r) <= least * (1.0 + kAsGood);
    });
    std::rotate(out.begin(), as_good, as_good + 1);
    std::stable_sort(out.begin() + 1, out.end(),
                     [](const auto& a, const auto& b) { return OpenAfter(a) < OpenAfter(b); });
    return out;
  }

  void Take(const PlannedReading& planned) {
    tried_.clear();
    settled_.clear();
    session_.readings.push_back(fit::PlannedRow(planned, like_));
    if (auto light = fit::FitAlone(session_, settings_)) now_ = std::move(light);
  }

  Session session_;
  const FitSettings& settings_;
  double reach_m_;
  Reading like_;
  double display_step_lx_;
  double last_digit_lx_;
  double coarse_step_lx_;
  std::vector<PlannedReading> skip_;
  Progress progress_, of_step_;
  std::optional<FittedLight> now_;
  Outcomes tried_, settled_;              // of this step
  std::optional<PlannedReading> stands_;  // where the meter does
};

}  // namespace

std::optional<double> RelativeUncertainty(const FittedLight& light) {
  const auto& u = light.intensity_cd ? light.intensity_cd : light.illuminance_lx;
  if (!u || !(u->value > 0.0)) return std::nullopt;
  return (u->low && u->high ? 0.5 * (*u->high - *u->low) : u->u95) / u->value;
}

bool SameStep(const PlannedReading& a, const PlannedReading& b) {
  return a.action == b.action && a.distance == b.distance && a.position_m == b.position_m &&
         a.off_axis == b.off_axis;
}

Result<ReadingPlan> PlanReadings(const Session& session, const std::string& light,
                                 const FitSettings& settings, int steps,
                                 std::optional<double> reach_m, const Progress& progress) {
  auto alone = fit::AloneIn(session, light);
  if (!alone) return Propagate(std::move(alone));
  Planner planner(*std::move(alone), settings, reach_m.value_or(LadderWishes{}.reach_m));
  planner.Tell(progress);
  return planner.Plan(steps);
}

Result<BeamPlan> PlanBeam(const Session& session, const std::string& light,
                          const FitSettings& settings, const LadderWishes& wishes) {
  auto alone = fit::AloneIn(session, light);
  if (!alone) return Propagate(std::move(alone));
  Planner planner(*std::move(alone), settings, wishes.reach_m);
  auto angle = planner.Plan(1, true);
  if (!angle) return Propagate(std::move(angle));
  planner.Skip(wishes.skip);
  planner.Tell(wishes.progress);
  auto ladder = planner.Ladder(wishes);
  if (!ladder) return Propagate(std::move(ladder));
  return BeamPlan{*std::move(angle), *std::move(ladder)};
}

double MeterU95Relative(const Session& session) {
  return LeftBy(fit::SharedCalibrationOf(session, fit::LikeTheLast(session))).relative;
}

Result<MinutesLadder> PlanMinutes(const Session& session, const std::string& light,
                                  const FitSettings& settings, const LadderWishes& wishes) {
  auto alone = fit::AloneIn(session, light);
  if (!alone) return Propagate(std::move(alone));
  Planner planner(*std::move(alone), settings, wishes.reach_m);
  planner.Skip(wishes.skip);
  planner.Tell(wishes.progress);
  return planner.Ladder(wishes);
}

}  // namespace lightcal
