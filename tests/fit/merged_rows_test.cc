// SPDX-License-Identifier: Apache-2.0
// Many readings are looked at as few before they are fitted: the answer is that of all readings.
#include "lightcal/fit/model/merged_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fitted.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/hypotheses.h"
#include "lightcal/fit/model/uncertainty.h"

namespace lightcal::fit {
namespace {

// A lamp of 1000 cd in a room, unknown kind: light from the walls by a power of the distance.
Session ManyReadings(std::uint64_t seed, int readings, double offset_m, double walls) {
  Session session;
  session.lights.emplace_back();
  session.lights.back().name = "lamp";
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, 0.02);
  for (int i = 0; i < readings; ++i) {
    const double d = 0.5 * std::pow(8.0, i / (readings - 1.0));
    const double r = d + offset_m;
    SessionReading row;
    row.reading.light = "lamp";
    row.reading.distance = Metres(d);
    row.reading.illuminance = Lux(1000.0 * (1.0 / (r * r) + walls / d) * std::exp(noise(random)));
    row.reading.sigma_relative = 0.02;
    session.readings.push_back(row);
  }
  return session;
}

// The full solver looks at every hypothesis with all of its rows.
void ExpectTheFullSolversAnswer(const Session& session, double tolerance) {
  FitSettings every;
  every.estimator.solver = SolverChoice::kFull;
  const auto quick = FitSession(session, FitSettings{});
  const auto full = FitSession(session, every);
  ASSERT_TRUE(quick.has_value() && full.has_value());
  const Uncertain& a = *quick->lights.lights[0].intensity_cd;
  const Uncertain& b = *full->lights.lights[0].intensity_cd;
  EXPECT_NEAR(a.value, b.value, tolerance * b.u95);
  EXPECT_NEAR(a.u95, b.u95, tolerance * b.u95);
  EXPECT_EQ(quick->lights.lights[0].fit.rejected.size(),
            full->lights.lights[0].fit.rejected.size());
}

TEST(ManyReadings, AreAnsweredAsIfEveryHypothesisWereSolvedWithAllOfThem) {
  std::uint64_t seed = 1;
  for (const int readings : {24, 60, 200}) {
    for (const double offset_m : {-0.15, 0.0, 0.05}) {
      for (const double walls : {0.0, 0.01, 0.08}) {
        ExpectTheFullSolversAnswer(ManyReadings(seed++, readings, offset_m, walls), 5e-3);
      }
    }
  }
}

TEST(ManyReadings, WithBlundersAreAnsweredSoToo) {
  for (const int blunder : {0, 20, 59}) {
    Session session = ManyReadings(7, 60, 0.03, 0.02);
    Lux& read = *session.readings[static_cast<std::size_t>(blunder)].reading.illuminance;
    read = Lux(3.0 * read.value());
    ExpectTheFullSolversAnswer(session, 5e-3);
  }
}

Estimation InARoom(int readings) {
  Estimation estimation;
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  for (int i = 0; i < readings; ++i) {
    ReadingRow row;
    row.distance = 0.35 * std::pow(8.0, i / (readings - 1.0));
    const double x = std::log(row.distance / 3.0);
    row.walls = WallsOfRow{x, 0.0, 0.07, i};
    row.measured =
        (std::pow(row.distance + 0.02, -2.0) + 0.1 * std::exp(-x)) * std::exp(noise(random));
    row.sigma = row.own_sigma = 0.02;
    estimation.rows.push_back(row);
  }
  estimation.rules[kLnIntensity].free = true;
  estimation.rules[kDistanceOffset] = {true, 0.0, 0.05};
  estimation.rules[kLnWalls] = {true, std::log(0.1), 0.42};
  estimation.rules[kWallsSlope] = {true, -1.0, 0.42};
  estimation.least_distance_offset = -0.3;
  return estimation;
}

TEST(MergedRows, HaveTheirOptimumWithinAPartOfAStandardDeviation) {
  Estimation all = InARoom(100);
  auto merged = Merge(all);
  ASSERT_TRUE(merged.has_value());
  EXPECT_LT(merged->estimation.rows.size(), 15u);
  const auto of_all = SolveSettled(all);
  const auto of_merged = SolveSettled(merged->estimation);
  ASSERT_TRUE(of_all.has_value() && of_merged.has_value());
  UncertaintyInput input;
  input.estimation = &all;
  input.theta = *of_all;
  const auto covariance = EstimateCovariance(input);
  ASSERT_TRUE(covariance.has_value());
  for (const Parameter k : {kLnIntensity, kDistanceOffset, kLnWalls, kWallsSlope}) {
    const double sd = std::sqrt((*covariance)[k * kParameters + k]);
    EXPECT_NEAR((*of_all)[k], (*of_merged)[k], sd) << int{k};
  }
}

TEST(MergedRows, TellHowMuchLikelierOneHypothesisIsThanAnother) {
  const auto evidences = [](double offset_mean) {
    Estimation all = InARoom(100);
    all.rules[kDistanceOffset].prior_mean = offset_mean;
    auto merged = Merge(all);
    const auto of_all = SolveSettled(all);
    const auto of_merged = SolveSettled(merged->estimation);
    return std::pair(LnEvidence(all, *of_all), LnEvidence(*merged, *of_merged));
  };
  const auto [near, near_merged] = evidences(0.0);
  const auto [far, far_merged] = evidences(-0.2);
  EXPECT_GT(near - far, 3.0);
  // Six apart, every hypothesis is solved with all rows (candidates.cc).
  EXPECT_NEAR(near - far, near_merged - far_merged, 2.0);
}

// How much the walls' light scatters depends on how much of it there is: the answer is where both
// agree, wherever one begins.
TEST(ScatterOfTheWalls, SettlesAtOnePlaceFromAnyStart) {
  Estimation asked = InARoom(6);
  for (ReadingRow& row : asked.rows) row.walls->scatter = 0.25;
  Estimation settled = asked;
  const auto optimum = SolveSettled(settled);
  ASSERT_TRUE(optimum.has_value());
  UncertaintyInput input;
  input.estimation = &settled;
  input.theta = *optimum;
  const auto covariance = EstimateCovariance(input);
  ASSERT_TRUE(covariance.has_value());
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    Theta start = *optimum;
    start[kLnIntensity] += uniform(random);
    start[kDistanceOffset] += 0.05 * uniform(random);
    start[kLnWalls] += uniform(random);
    start[kWallsSlope] += uniform(random);
    Estimation again = asked;
    const auto found = SolveSettledFrom(start, again);
    ASSERT_TRUE(found.has_value());
    for (const Parameter k : {kLnIntensity, kDistanceOffset, kLnWalls, kWallsSlope}) {
      const double sd = std::sqrt((*covariance)[k * kParameters + k]);
      EXPECT_NEAR((*found)[k], (*optimum)[k], 1e-3 * sd) << int{k} << " from start " << i;
    }
    for (std::size_t row = 0; row < again.rows.size(); ++row) {
      EXPECT_NEAR(again.rows[row].sigma / settled.rows[row].sigma, 1.0, 1e-3);
    }
  }
}

// What the walls throw to one place scatters once, however often it is read there: the place says
// no more of what the lamp is, only of how bright it is.
TEST(ScatterOfTheWalls, OnePlaceSaysNoMoreOfTheLampTheOftenerItIsRead) {
  const auto read = [](int times) {
    Session session;
    MeterDescription meter;
    meter.name = "m";
    meter.sigma_relative = 0.03;
    session.meters = {meter};
    LightDescription lamp;
    lamp.name = "lamp";
    session.lights = {lamp};
    std::mt19937_64 random(31);
    std::normal_distribution<double> noise(0.0, 0.005);
    double sum = 0.0;
    for (int i = 0; i < times; ++i) {
      Reading reading;
      reading.light = "lamp";
      reading.meter = "m";
      reading.distance = Metres(1.0);
      reading.illuminance = Lux(100.0 * std::exp(noise(random)));
      sum += reading.illuminance->value();
      session.readings.push_back({reading, "typed"});
    }
    for (SessionReading& row : session.readings) {
      row.reading.illuminance = Lux(row.reading.illuminance->value() * 100.0 * times / sum);
    }
    return test::FitOk(session);
  };
  const FittedLight once = read(1);
  for (const int times : {3, 20, 60}) {  // from 24 on they are looked at merged first
    const FittedLight often = read(times);
    EXPECT_NEAR(often.intensity_cd->value / once.intensity_cd->value, 1.0, 1e-3) << times;
    EXPECT_LT(often.intensity_cd->u95, once.intensity_cd->u95) << times;
    ASSERT_EQ(often.in_room.size(), once.in_room.size()) << times;
    for (std::size_t k = 0; k < once.in_room.size(); ++k) {
      EXPECT_NEAR(often.in_room[k].weight, once.in_room[k].weight, 1e-3) << times << " times";
    }
  }
}

TEST(MergedRows, AreNoneWhereTheyWouldNotBeFewer) { EXPECT_FALSE(Merge(InARoom(8)).has_value()); }

}  // namespace
}  // namespace lightcal::fit
