// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/plan/plan_readings.h"

namespace lightcal {
namespace {

// Distances in geometric steps tell offset and ambient light best; together they should span 8 : 1.
constexpr double kStep = 2.8284271247461903;
constexpr double kSpan = 8.0;

struct Taken {
  std::vector<double> distances_m;  // of readings with the lamp on, sorted
  bool shadow = false;
  bool off = false;
  bool own = false;  // someone held a meter: not every figure is the manufacturer's
};

Taken TakenOf(const Session& session, const FittedLight& light) {
  Taken taken;
  for (const SessionReading& row : session.readings) {
    const Reading& reading = row.reading;
    if (reading.light != light.name || !reading.illuminance) continue;
    taken.shadow = taken.shadow || reading.shadow_card;
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

// A lamp that places told is told better by another place.
std::optional<std::string> AboutPlace(const Session& session, const FittedLight& light) {
  if (!light.position_u95_m) return std::nullopt;
  const auto plan = PlanReadings(session, light.name, {}, 1);
  if (!plan || plan->steps.empty() || !plan->u95_relative) return std::nullopt;
  const PlannedReading& step = plan->steps.front();
  const auto percent = [](double part) { return "± " + PercentText(part); };
  return SayPlannedReading(step) + ": it leaves " + percent(step.u95_relative) + " instead of " +
         percent(*plan->u95_relative);
}

// A beam is told best at another angle.
std::optional<std::string> AboutBeam(const Session& session, const FittedLight& light) {
  if (!light.beam || !light.beam->beam_deg) return std::nullopt;
  const auto plan = PlanAngle(session, light.name, {});
  if (!plan || plan->steps.empty() || !plan->beam_u95_deg) return std::nullopt;
  const PlannedReading& step = plan->steps.front();
  if (!step.beam_u95_deg) return std::nullopt;
  const auto degrees = [](double u95) { return "± " + RoundedText(u95, 2) + "°"; };
  return SayPlannedReading(step) + ": beam angle " + degrees(*plan->beam_u95_deg) + " → " +
         degrees(*step.beam_u95_deg) + ", intensity ± " + PercentText(*plan->u95_relative) +
         " → ± " + PercentText(step.u95_relative);
}

// Whether the walls are a large part of what is not known.
bool WallsDecide(const FittedLight& light) {
  for (const BudgetPart& part : light.budget) {
    constexpr double kLarge = 0.2;  // of the variance
    if (part.name == "room_bounce") return part.share > kLarge;
  }
  return false;
}

// The card that tells most of the walls' light, with what it leaves.
std::optional<std::string> AboutWalls(const Session& session, const FittedLight& light) {
  if (!WallsDecide(light)) return std::nullopt;
  const auto plan = PlanShadowCard(session, light.name, {});
  if (!plan || plan->steps.empty() || !plan->u95_relative) return std::nullopt;
  const PlannedReading& card = plan->steps.front();
  if (!(card.u95_relative < *plan->u95_relative)) return std::nullopt;
  return SayPlannedReading(card) + ": ± " + PercentText(*plan->u95_relative) + " → ± " +
         PercentText(card.u95_relative);
}

}  // namespace

std::string NextStep(const Session& session, const FittedLight& light) {
  if (auto angle = AboutBeam(session, light)) return *angle;
  if (auto place = AboutPlace(session, light)) return *place;
  const Taken taken = TakenOf(session, light);
  if (taken.distances_m.empty()) {
    return "measure the illuminance facing the lamp, about ten times its size away: so far only "
           "its "
           "data sheet speaks";
  }
  if (!fit::HasDistanceLaw(light.kind)) {
    return taken.off ? "read again at the same place: repeated readings lower the uncertainty"
                     : "read once with the lamp off: it takes the other light out";
  }
  if (auto again = AboutRejected(light)) return *again;
  const double nearest = taken.distances_m.front();
  if (IsPrior(light, "intensity")) {
    return ReadAgainAt(nearest / kStep, "the lamp cannot be told from the other light");
  }
  const double farthest = taken.distances_m.back();
  if (!taken.own) {
    return "measure your own lamp once at " + RoundedText(nearest, 2) +
           " m: so far only the manufacturer's figures speak";
  }
  if (taken.distances_m.size() > 1) {
    if (auto walls = AboutWalls(session, light)) return *walls;
  }
  if (IsPrior(light, "distance_offset")) {
    return ReadAgainAt(farthest / nearest < kSpan ? farthest * kStep : nearest / kStep,
                       "the distance offset is still a prior");
  }
  if (!taken.shadow && session.surroundings == Surroundings::kIndoors) {
    return "add a shadow-card reading at " + RoundedText(farthest, 2) +
           " m (block only the direct beam): it takes ambient light and the room's bounce out";
  }
  if (farthest / nearest < kSpan) {
    return ReadAgainAt(farthest * kStep, "distances that span 8 : 1 tell the offset best");
  }
  return "read again at " + RoundedText(nearest, 2) +
         " m with another meter: the meter's own calibration is what is left";
}

}  // namespace lightcal
