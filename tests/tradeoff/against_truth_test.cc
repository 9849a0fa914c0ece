// SPDX-License-Identifier: Apache-2.0
// Errors against a truth, on calibrations whose errors are known by construction.
#include "lightcal/tradeoff/against_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace lightcal::tradeoff {
namespace {

constexpr double kSd = 0.02, kBias = 0.05, kTruth = 6.0;
constexpr ReplicaRules kMany{.replicas = 4000, .least = 4000, .seconds = 1.0};

LightFigures Light(const std::string& name, double ln_strength) {
  LightFigures light;
  light.name = name;
  light.ln_strength = ln_strength;
  light.sd_ln = kSd;
  return light;
}

// Normal errors of kSd; without effects the fill light is biased too.
Result<std::vector<LightFigures>> Read(const AccuracyProfile& profile, int replica) {
  std::mt19937_64 random(static_cast<std::uint64_t>(replica) + 1);
  std::normal_distribution<double> noise(0.0, kSd);
  const double key = kTruth + noise(random), fill = kTruth + noise(random);
  return std::vector<LightFigures>{Light("key", key),
                                   Light("fill", fill + (profile.effects == "none" ? kBias : 0.0))};
}

const std::vector<LightFigures> kLights = {Light("key", kTruth), Light("fill", kTruth)};

AccuracyProfile WithEffects(const std::string& effects) {
  AccuracyProfile profile;
  profile.effects = effects;
  return profile;
}

TEST(AgainstTruth, ErrorsAndIntervalsAreThoseOfTheNoise) {
  const std::vector<Named> profiles = {{"all", WithEffects("all")}, {"none", WithEffects("none")}};
  const auto rows = CompareWithTruth(Read, kLights, profiles, kMany, {});
  ASSERT_TRUE(rows);
  const TruthRow &all = (*rows)[0], &none = (*rows)[1];
  EXPECT_EQ(all.replicas, 4000);
  EXPECT_EQ(all.intervals, 8000);
  EXPECT_NEAR(all.mean, 0.0, 0.001);
  EXPECT_NEAR(all.rms, kSd, 0.001);
  EXPECT_NEAR(all.held_share(), 0.95, 0.01);
  EXPECT_EQ(none.light, "fill");
  EXPECT_NEAR(none.mean, kBias, 0.001);
  EXPECT_NEAR(none.rms, std::hypot(kSd, kBias), 0.001);
  // |N(2.5, 1)| stays below 1.96 in 29.5 % of the fill light's, in 95 % of the key's.
  EXPECT_NEAR(none.held_share(), (0.295 + 0.95) / 2.0, 0.01);
}

TEST(AgainstTruth, ARefusalIsCountedAndTimeEndsIt) {
  const ReplicaRunner every_other = [](const AccuracyProfile& p,
                                       int replica) -> Result<std::vector<LightFigures>> {
    if (replica % 2 == 1) return Refused("no_valid_readings", "key", "none left");
    return Read(p, replica);
  };
  const std::vector<Named> profiles = {{"usual", {}}};
  const auto rows = CompareWithTruth(every_other, kLights, profiles,
                                     {.replicas = 100000000, .least = 20, .seconds = 0.01}, {});
  ASSERT_TRUE(rows);
  EXPECT_GE(rows->front().replicas, 10);
  EXPECT_NEAR(rows->front().refused, rows->front().replicas, 1);
}

TEST(AgainstTruth, StopsWhenAsked) {
  int asked = 0;
  Watch watch;
  watch.stopped = [&] { return ++asked > 3; };
  const std::vector<Named> profiles = {{"usual", {}}};
  const auto rows = CompareWithTruth(Read, kLights, profiles, kMany, watch);
  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error().code, "interrupted");
}

TruthRow Row(const std::string& name, double rms, int held) {
  TruthRow row;
  row.name = name;
  row.replicas = row.intervals = 200;
  row.rms = rms;
  row.held = held;
  return row;
}

// A third more of an error adds 5.4 % to the root of squares; 190 of 200 are 95 %, 184 two standard
// errors fewer.
TEST(AgainstTruth, ASettingHoldsWhereItsErrorsAndIntervalsAreAsGood) {
  const TruthRow strict = Row("strictest", 0.03, 190);
  EXPECT_TRUE(HoldsTruth(Row("a", 0.0316, 190), strict, 0.02));
  EXPECT_FALSE(HoldsTruth(Row("a", 0.0317, 190), strict, 0.02));
  EXPECT_FALSE(HoldsTruth(Row("a", 0.0302, 190), strict, 0.001)) << "beyond the tolerance";
  EXPECT_TRUE(HoldsTruth(Row("a", 0.03, 184), strict, 0.02));
  EXPECT_FALSE(HoldsTruth(Row("a", 0.03, 183), strict, 0.02));
  TruthRow refused = Row("a", 0.03, 190);
  refused.replicas = 199;
  EXPECT_FALSE(HoldsTruth(refused, strict, 0.02));
}

// Errors of the reference say nothing of it: the loose solver is cheap, and wrong.
TEST(AgainstTruth, TheRecommendationIsTheCheapestThatHoldsTheTruth) {
  const Runner run = [](const AccuracyProfile& p) -> Result<Outcome> {
    const bool loose = p.estimator.solver == SolverChoice::kLoose;
    const bool few = p.pictures.pixel_stride == 4;
    Outcome out;
    out.lights = {Light("key", kTruth)};
    out.seconds = {0.0, 0.0, few ? 0.02 : 0.10, loose ? 0.01 : 0.10, 0.0};
    return out;
  };
  Question question;
  question.knobs = {"solver", "pixels"};
  question.alone = question.together = question.sure = {.least_runs = 5, .most_runs = 5};
  auto study = StudyTradeoff(run, question, {});
  ASSERT_TRUE(study) << study.error().message;
  ASSERT_NEAR(study->saved_share, 0.85, 1e-9) << "both seem free";
  std::vector<TruthRow> rows = {Row("strictest", 0.03, 190), Row("as usual", 0.03, 190),
                                Row("solver loose", 0.09, 100), Row("pixels quarter", 0.03, 189),
                                Row(NameOf(study->recommended.levels), 0.09, 100)};
  ASSERT_TRUE(RecommendByTruth(run, question, {}, rows.front(), rows, *study));
  EXPECT_EQ(NameOf(study->recommended.levels), "pixels quarter");
  EXPECT_NEAR(study->saved_share, 0.4, 1e-9);
  rows[3].held = 100;
  ASSERT_TRUE(RecommendByTruth(run, question, {}, rows.front(), rows, *study));
  EXPECT_EQ(NameOf(study->recommended.levels), "as usual");
  EXPECT_EQ(study->saved_share, 0.0);
}

}  // namespace
}  // namespace lightcal::tradeoff
