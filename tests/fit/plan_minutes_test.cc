// SPDX-License-Identifier: Apache-2.0
// What a ladder promises for the minutes of its steps is what its readings bring.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "lamp_twin.h"
#include "lightcal/core/statistics.h"
#include "lightcal/core/stops.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/fit/plan/plan_readings.h"

namespace lightcal {
namespace {

using test::LampTruth;
using test::TwinSession;

constexpr double kSigma = 0.02;

Session EmptySession(double calibration) {
  Session session = TwinSession(LampTruth{}, kSigma, 1).session();
  MeterDescription meter;
  meter.name = "m";
  meter.sigma_relative = kSigma;
  meter.calibration_relative = calibration;
  session.meters = {meter};
  return session;
}

MinutesLadder LadderOf(const Session& session, const LadderWishes& wishes = {}) {
  auto ladder = PlanMinutes(session, "lamp", {}, wishes);
  EXPECT_TRUE(ladder.has_value()) << ladder.error().message;
  return ladder ? *std::move(ladder) : MinutesLadder{};
}

TEST(PlanMinutes, EveryRungBringsWhatItPromises) {
  const MinutesLadder ladder = LadderOf(EmptySession(0.0));
  EXPECT_FALSE(ladder.u95_relative);
  ASSERT_GE(ladder.steps.size(), 4U);
  std::mt19937_64 random(71);
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> ratios(ladder.steps.size());
  for (int i = 0; i < 100; ++i) {
    LampTruth truth;
    truth.intensity_cd = std::exp(5.0 + normal(random));
    truth.offset_m = 0.02 * normal(random);
    TwinSession twin(truth, kSigma, random());
    for (std::size_t k = 0; k < ladder.steps.size(); ++k) {
      const PlannedReading& step = ladder.steps[k].reading;
      if (step.action == PlannedAction::kRead) twin.On(step.distance->value());
      if (step.action == PlannedAction::kShadowCard) twin.ShadowCard(step.distance->value());
      if (step.action == PlannedAction::kLampOff) twin.Off();
      const auto fitted = FitSession(twin.session(), {});
      ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
      const auto got = RelativeUncertainty(fitted->lights.lights.front());
      ASSERT_TRUE(got.has_value());
      ratios[k].push_back(*got / step.u95_relative);
    }
  }
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    EXPECT_NEAR(Median(ratios[k]), 1.0, 0.15) << "rung " << k + 1;
  }
}

TEST(PlanMinutes, AStepCostsItsReadingAndTheWayThere) {
  LadderWishes wishes;
  wishes.minutes = {.reading = 7.0, .card = 0.5, .move = 11.0};
  const MinutesLadder ladder = LadderOf(EmptySession(0.0), wishes);
  double total = 0.0;
  const PlannedReading* stands = nullptr;
  for (const LadderStep& step : ladder.steps) {
    const PlannedReading& reading = step.reading;
    const bool moves = reading.action != PlannedAction::kLampOff &&
                       (stands == nullptr || stands->distance != reading.distance);
    const bool card = reading.action == PlannedAction::kShadowCard;
    EXPECT_EQ(step.minutes, (moves ? 11.0 : 0.0) + (card ? 0.5 : 7.0)) << step.say;
    EXPECT_EQ(step.total_minutes, total += step.minutes);
    if (reading.action != PlannedAction::kLampOff) stands = &reading;
  }
}

TEST(PlanMinutes, EachRungLeavesLessAndNoneStandsOutOfReach) {
  TwinSession twin(LampTruth{}, kSigma, 3);
  twin.On(0.5);
  LadderWishes wishes;
  wishes.reach_m = 1.5;
  const MinutesLadder ladder = LadderOf(twin.session(), wishes);
  ASSERT_TRUE(ladder.u95_relative);
  ASSERT_FALSE(ladder.steps.empty());
  double left = *ladder.u95_relative;
  for (const LadderStep& step : ladder.steps) {
    EXPECT_LT(step.reading.u95_relative, 0.98 * left) << step.say;
    left = step.reading.u95_relative;
    if (step.reading.distance) {
      EXPECT_LE(step.reading.distance->value(), 1.5);
    }
  }
}

TEST(PlanMinutes, TheMetersOwnCalibrationIsTheFloor) {
  const MinutesLadder ladder = LadderOf(EmptySession(0.019));
  EXPECT_NEAR(ladder.meter_u95_relative, std::sinh(kZ95 * 0.019), 1e-12);
  ASSERT_FALSE(ladder.steps.empty());
  EXPECT_FALSE(ladder.steps.front().meter_limits) << "the offset is open";
  EXPECT_TRUE(ladder.steps.back().meter_limits);
  for (const LadderStep& step : ladder.steps) {
    EXPECT_GT(step.reading.u95_relative, ladder.meter_u95_relative);
  }
  Session two = EmptySession(0.019);  // and another meter, as sure, has read already
  two.meters.push_back(two.meters.front());
  two.meters.back().name = "n";
  two.readings = TwinSession(LampTruth{}, kSigma, 4).On(1.0).session().readings;
  two.readings.front().reading.meter = "n";
  two.readings.push_back(two.readings.front());
  two.readings.back().reading.meter = "m";
  EXPECT_NEAR(LadderOf(two).meter_u95_relative, std::sinh(kZ95 * 0.019 / std::sqrt(2.0)), 1e-12);
  const MinutesLadder own = LadderOf(EmptySession(0.0));
  EXPECT_EQ(own.meter_u95_relative, 0.0);
  for (const LadderStep& step : own.steps) EXPECT_FALSE(step.meter_limits);
}

// A step of those that PlanReadings ranks, each settled, takes so much off ln of the stops a
// minute.
double RateOf(const PlannedReading& step, double stops_now, double stands_m) {
  const MeasuringMinutes minutes;
  const bool stays = step.action == PlannedAction::kLampOff || step.distance->value() == stands_m;
  const bool card = step.action == PlannedAction::kShadowCard;
  const double took = (stays ? 0.0 : minutes.move) + (card ? minutes.card : minutes.reading);
  return std::log(stops_now / step.u95_stops) / took;
}

// Readings that contradict one another, lamps whose offset is known or not, in rooms and in the
// dark: what is judged at its first guess alone must not have been the best.
TEST(PlanMinutes, TheFirstStepIsTheBestOfAllSettledToTheEnd) {
  std::mt19937_64 random(29);
  std::normal_distribution<double> normal;
  int asked = 0, others = 0;
  for (int i = 0; i < 60; ++i) {
    LampTruth truth;
    truth.intensity_cd = std::exp(5.0 + normal(random));
    truth.offset_m = 0.1 * normal(random);
    TwinSession twin(truth, i % 2 == 0 ? kSigma : 5.0 * kSigma, random());
    const std::vector<double> distances = {0.35, 0.5, 0.7, 1.0, 1.4, 2.0};
    const auto first = static_cast<std::size_t>(i) % 4;
    double stands_m = 0.0;
    for (std::size_t k = first; k < distances.size(); k += 1 + first) {
      twin.On(stands_m = distances[k]);
    }
    Session session = twin.session();
    if (i % 3 == 0) session.surroundings = Surroundings::kIndoors;
    if (i % 5 == 1) {  // one meter, whose calibration no reading helps
      session.meters = EmptySession(kSigma).meters;
      for (SessionReading& row : session.readings) row.reading.meter = "m";
    }
    const auto fitted = FitSession(session, {});
    const auto plan = PlanReadings(session, "lamp", {}, 1);
    if (!fitted || !plan) continue;
    const auto stops = HalfWidthStops(*fitted->lights.lights.front().intensity_cd);
    if (!stops) continue;
    LadderWishes wishes;
    wishes.steps = 1;
    const MinutesLadder ladder = LadderOf(session, wishes);
    const auto rate = [&](const PlannedReading& step) { return RateOf(step, *stops, stands_m); };
    const auto best = std::ranges::max_element(plan->candidates, {}, rate);
    ++asked;
    if (ladder.steps.empty()) {
      EXPECT_LT(std::log(*stops / best->u95_stops), 0.02) << i;
      continue;
    }
    EXPECT_NEAR(rate(ladder.steps.front().reading), rate(*best), 1e-9) << i;
    others += SameStep(plan->candidates.front(), *best) ? 0 : 1;
  }
  EXPECT_GE(asked, 40);
  EXPECT_GE(others, 5) << "the best of its minutes is not always what leaves least";
}

TEST(PlanMinutes, AnUnknownLightIsRefused) {
  const auto ladder = PlanMinutes(EmptySession(0.0), "no such", {}, {});
  ASSERT_FALSE(ladder);
  EXPECT_EQ(ladder.error().code, "unknown_light");
}

}  // namespace
}  // namespace lightcal
