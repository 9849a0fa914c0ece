// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/plan/next_step.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "lightcal/core/interval_text.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/plan/plan_readings.h"

namespace lightcal {
namespace {

constexpr double kStep = 2.8284271247461903;

struct Taken {
  std::vector<double> distances_m;  // of readings with the lamp on, sorted
  bool off = false;
  bool own = false;  // someone held a meter: not every figure is the manufacturer's
};

Taken TakenOf(const Session& session, const FittedLight& light) {
  Taken taken;
  for (const SessionReading& row : session.readings) {
    const Reading& reading = row.reading;
    if (reading.light != light.name || !reading.illuminance) continue;
    taken.off = taken.off || (reading.lamp == LampState::kOff && !reading.shadow_card);
    taken.own = taken.own || reading.meter != kDataSheetMeter;
    const bool lit = reading.lamp == LampState::kOn && !reading.shadow_card;
    if (!lit || !light.residuals.empty()) continue;
    if (reading.distance && reading.distance->value() > 0.0) {
      taken.distances_m.push_back(reading.distance->value());
    }
  }
  for (const ResidualRow& row : light.residuals) {
    if (row.distance_m) taken.distances_m.push_back(*row.distance_m);
  }
  std::sort(taken.distances_m.begin(), taken.distances_m.end());
  return taken;
}

bool IsPrior(const FittedLight& light, std::string_view parameter) {
  return std::find(light.fit.prior.begin(), light.fit.prior.end(), parameter) !=
         light.fit.prior.end();
}

std::string ReadAgainAt(double distance_m, const std::string& why) {
  return "read again at " + RoundedText(distance_m, 2) + " m, facing the lamp: " + why;
}

std::optional<std::string> AboutRejected(const FittedLight& light) {
  for (const ResidualRow& row : light.residuals) {
    if (row.used || !row.distance_m) continue;
    return ReadAgainAt(*row.distance_m, "the reading there disagrees with the others");
  }
  return std::nullopt;
}

std::string LeftAfter(const PlannedReading& reading) {
  return RelativeText(IntervalOfWidths(reading.u95_relative, reading.u95_stops));
}

// Of a plan or a ladder, "" before any reading.
template <class Plan>
std::string Now(const Plan& plan) {
  return plan.u95_relative ? RelativeText(IntervalOfWidths(*plan.u95_relative, plan.u95_stops))
                           : "";
}

NextStepAdvice Say(std::string sentence) {
  NextStepAdvice advice;
  advice.say = std::move(sentence);
  return advice;
}

// Nearer, the lamp outshines the rest; how much that buys no plan knows.
NextStepAdvice SayReadNearer(double nearest_m) {
  NextStepAdvice advice =
      Say(ReadAgainAt(nearest_m / kStep, "the lamp cannot be told from the other light"));
  constexpr double kNearest_m = 0.1;  // where a hand's breadth of the lamp is no point any more
  const double metres = ParseNumber(RoundedText(nearest_m / kStep, 2)).value();  // as it is said
  if (metres >= kNearest_m) {
    advice.reading = PlannedReading{PlannedAction::kRead, Metres(metres), {}, {}};
  }
  return advice;
}

NextStepAdvice Take(PlannedReading reading, double minutes, const std::string& now) {
  NextStepAdvice advice;
  advice.kind = NextStepAdvice::Kind::kReading;
  advice.say =
      SayPlannedReading(reading) + ": " + now + (now.empty() ? "" : " → ") + LeftAfter(reading);
  advice.reading = std::move(reading);
  advice.minutes = minutes;
  return advice;
}

// A lamp that places told is told better by another place.
std::optional<NextStepAdvice> AboutPlace(const Session& session, const FittedLight& light) {
  if (!light.position_u95_m) return std::nullopt;
  auto plan = PlanReadings(session, light.name, {}, 1);
  if (!plan || plan->steps.empty() || !plan->u95_relative) return std::nullopt;
  const MeasuringMinutes minutes;
  return Take(std::move(plan->steps.front()), minutes.move + minutes.reading, Now(*plan));
}

// A beam is told at another angle.
struct AngleAdvice {
  NextStepAdvice advice;
  double gain = 0.0;  // of ln of the beam angle's interval
};
std::optional<AngleAdvice> AboutAngle(ReadingPlan&& plan) {
  if (plan.steps.empty() || !plan.beam_u95_deg) return std::nullopt;
  PlannedReading& step = plan.steps.front();
  if (!step.beam_u95_deg) return std::nullopt;
  const auto degrees = [](double u95) { return "± " + RoundedText(u95, 2) + "°"; };
  const std::string beam = ": beam angle " + degrees(*plan.beam_u95_deg) + " → " +
                           degrees(*step.beam_u95_deg) + ", intensity " + Now(plan) + " → " +
                           LeftAfter(step);
  const double gain = std::log(*plan.beam_u95_deg / *step.beam_u95_deg);
  const MeasuringMinutes minutes;
  NextStepAdvice advice = Take(std::move(step), minutes.move + minutes.reading, "");
  advice.say = SayPlannedReading(*advice.reading) + beam;
  return AngleAdvice{std::move(advice), gain};
}

// Off ln of the intensity's interval.
double GainOf(const NextStepAdvice& advice, const FittedLight& light) {
  const auto now = RelativeUncertainty(light);
  if (!advice.reading || !now || !(advice.reading->u95_relative > 0.0)) return 0.0;
  return std::log(*now / advice.reading->u95_relative);
}

LadderWishes OneStep(const Session& session, const std::vector<PlannedReading>& skip,
                     const Progress& progress) {
  LadderWishes wishes;
  wishes.skip = skip;
  wishes.progress = progress;
  wishes.reach_m = ReachIn(session);
  wishes.steps = 1;
  return wishes;
}

NextStepAdvice WhatMinutesBuy(Result<MinutesLadder> ladder) {
  NextStepAdvice nothing;
  nothing.kind = NextStepAdvice::Kind::kNothing;
  nothing.say = "no reading within reach would take 2 % off what is left";
  if (!ladder) return nothing;
  const double now = ladder->u95_relative.value_or(0.0);
  const double meter = ladder->meter_u95_relative;
  constexpr double kWorthWhile = 0.9;  // of what is left, where the meter is most of it
  const bool meter_is_most = 2.0 * meter * meter > now * now;
  const bool helps =
      !ladder->steps.empty() &&
      (!meter_is_most || ladder->steps.front().reading.u95_relative < kWorthWhile * now);
  if (helps) {
    LadderStep& step = ladder->steps.front();
    return Take(std::move(step.reading), step.minutes, Now(*ladder));
  }
  if (!meter_is_most) return nothing;
  NextStepAdvice advice;
  advice.kind = NextStepAdvice::Kind::kMeter;
  advice.say = "the meter is the limit: its own " + RelativeText(IntervalOfFactor(meter)) +
               " stays however often it reads; only another meter helps";
  return advice;
}

}  // namespace

// From anywhere in a room one can stand half of its longest side away.
double ReachIn(const Session& session) {
  constexpr double kOpen_m = 4.0;
  constexpr double kUnknownRoom_m = 2.0;
  if (session.room) return 0.5 * std::max(session.room->size_m[0], session.room->size_m[1]);
  return session.surroundings == Surroundings::kIndoors ? kUnknownRoom_m : kOpen_m;
}

std::string NextStep(const Session& session, const FittedLight& light) {
  return AdviseNext(session, light).say;
}

NextStepAdvice AdviseNext(const Session& session, const FittedLight& light,
                          const std::vector<PlannedReading>& skip, const Progress& progress) {
  const auto wanted = [&](const std::optional<NextStepAdvice>& advice) {
    return advice && std::ranges::none_of(skip, [&](const PlannedReading& one) {
             return SameStep(one, *advice->reading);
           });
  };
  const LadderWishes wishes = OneStep(session, skip, progress);
  std::optional<MinutesLadder> of_beam;
  if (light.beam && light.beam->beam_deg) {
    if (auto plan = PlanBeam(session, light.name, {}, wishes)) {
      auto angle = AboutAngle(std::move(plan->angle));
      of_beam = std::move(plan->ladder);
      if (angle && wanted(angle->advice)) {
        NextStepAdvice bought = WhatMinutesBuy(*std::move(of_beam));
        return GainOf(bought, light) > angle->gain ? bought : std::move(angle->advice);
      }
    }
  }
  if (auto place = AboutPlace(session, light); wanted(place)) return *std::move(place);
  const Taken taken = TakenOf(session, light);
  if (taken.distances_m.empty()) {
    if (light.fit.used > 0 && !light.budget.empty()) {  // a wall told it
      const BudgetPart& most = light.budget.front();
      return Say("of its uncertainty " + PercentText(most.share) + " is " + most.name + ": " +
                 most.halve);
    }
    return Say(
        "measure the illuminance facing the lamp, about ten times its size away: so far only its "
        "data sheet speaks");
  }
  if (!fit::HasDistanceLaw(light.kind)) {
    return Say(taken.off ? "read again at the same place: repeated readings lower the uncertainty"
                         : "read once with the lamp off: it takes the other light out");
  }
  if (auto again = AboutRejected(light)) return Say(*again);
  const double nearest = taken.distances_m.front();
  if (IsPrior(light, "intensity")) {
    return SayReadNearer(nearest);
  }
  if (!taken.own) {
    return Say("measure your own lamp once at " + RoundedText(nearest, 2) +
               " m: so far only the manufacturer's figures speak");
  }
  NextStepAdvice bought =
      WhatMinutesBuy(of_beam ? *std::move(of_beam) : PlanMinutes(session, light.name, {}, wishes));
  // A step that leaves the lamp unknown to a factor of two either way tells as little as none.
  if (bought.reading && bought.reading->u95_stops >= 1.0) {
    return SayReadNearer(nearest);
  }
  return bought;
}

}  // namespace lightcal
