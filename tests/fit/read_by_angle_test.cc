// SPDX-License-Identifier: Apache-2.0
// Readings that say their angle off the axis, of lamps whose size, cone or fixture is stated: what
// the lamp sends there comes from area_twin.h, which knows on which side the meter stood.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "area_twin.h"
#include "lightcal/fit/fit_light.h"
#include "trials.h"

namespace lightcal {
namespace {

using test::AreaTwin;
using test::LampOfKind;
using test::TrialsOf;

constexpr double kRadiansOfDegree = std::numbers::pi / 180.0;

// A rect four times as wide as high: which side the meter went counts most of it.
AreaTwin AimedTwin(LightKind kind) {
  AreaTwin twin = LampOfKind(kind);
  if (kind == LightKind::kRect) {
    twin.light.width = Metres(1.2);
    twin.light.height = Metres(0.3);
  }
  return twin;
}

// A session of the dark says the lamp's kind, not where it is.
Session SessionOf(const LightDescription& light) {
  Session out;
  out.surroundings = Surroundings::kDark;
  out.lights.push_back(light);
  out.lights.front().position_m.reset();
  out.lights.front().aim.reset();
  return out;
}

SessionReading ReadingAt(double distance_m, double off_axis_deg, double lux) {
  SessionReading row;
  row.reading.light = "lamp";
  row.reading.distance = Metres(distance_m);
  row.reading.off_axis = RadiansFromDegrees(off_axis_deg);
  row.reading.illuminance = Lux(lux);
  row.reading.sigma_relative = 0.01;
  return row;
}

// Facing the lamp, `angle_rad` off its axis and `round_rad` about it.
double LuxAt(const AreaTwin& twin, double distance_m, double angle_rad, double round_rad) {
  const Vec3 way{std::sin(angle_rad) * std::cos(round_rad), std::cos(angle_rad),
                 std::sin(angle_rad) * std::sin(round_rad)};
  return TrueLux(twin, way * distance_m, way * -1.0);
}

class ReadByAngle : public testing::TestWithParam<LightKind> {};

TEST_P(ReadByAngle, GivesTheAxis) {
  AreaTwin twin = AimedTwin(GetParam());
  twin.intensity_cd = 700.0;
  for (const double degrees : {0.0, 12.0, -12.0, 30.0, 60.0}) {
    SCOPED_TRACE(degrees);
    if (GetParam() == LightKind::kSpot && degrees > 20.0) continue;
    Session session = SessionOf(twin.light);
    const double lux = LuxAt(twin, 4.0, degrees * kRadiansOfDegree, 0.25 * std::numbers::pi);
    session.readings.push_back(ReadingAt(4.0, degrees, lux));
    const auto fitted = FitSession(session, {});
    ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
    EXPECT_NEAR(fitted->lights.lights.front().intensity_cd->value / 700.0, 1.0, 0.01);
  }
}

// Angles and the axis to a degree, one side of the lamp for all of them.
TEST_P(ReadByAngle, NinetyFiveOfAHundredIntervalsHoldTheTruth) {
  constexpr int kTwins = TrialsOf(1000);
  std::mt19937_64 random(20261128);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const double widest_deg = GetParam() == LightKind::kSpot ? 30.0 : 65.0;
  int covered = 0;
  for (int i = 0; i < kTwins; ++i) {
    AreaTwin twin = AimedTwin(GetParam());
    twin.intensity_cd = std::exp(5.0 + 2.0 * normal(random));
    if (GetParam() != LightKind::kSpot) twin.offset_m = 0.03 * normal(random);
    const double axis_deg = normal(random);
    const double round_rad = 2.0 * std::numbers::pi * uniform(random);
    Session session = SessionOf(twin.light);
    for (const double distance : {1.0, 1.5, 2.5, 4.0}) {
      const double said_deg = std::round(5.0 + (widest_deg - 5.0) * uniform(random));
      const double true_deg = said_deg + axis_deg + normal(random);
      const double lux = LuxAt(twin, distance, true_deg * kRadiansOfDegree, round_rad);
      session.readings.push_back(
          ReadingAt(distance, said_deg, lux * std::exp(0.01 * normal(random))));
    }
    const auto fitted = FitSession(session, {});
    ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
    const Uncertain& found = *fitted->lights.lights.front().intensity_cd;
    covered += twin.intensity_cd >= *found.low && twin.intensity_cd <= *found.high ? 1 : 0;
  }
  if (test::kUnderAddressSanitizer) return;
  EXPECT_GE(covered, 930);
  EXPECT_LE(covered, 985);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ReadByAngle,
                         testing::Values(LightKind::kSpot, LightKind::kDisk, LightKind::kRect),
                         [](const auto& kind) { return std::string(LightKindName(kind.param)); });

// Four readings that two lamps explain about as well: which one Huber's loss takes hangs on a hair.
TEST(ReadByAngle, DistancesThatAreLessSureMakeNoRefusal) {
  Session session = SessionOf(LampOfKind(LightKind::kSpot).light);
  session.readings = {ReadingAt(1.0, 16.0, 57.82744164), ReadingAt(1.5, 10.0, 29.68780204),
                      ReadingAt(2.5, 15.0, 10.39828119), ReadingAt(4.0, 12.0, 4.097883842)};
  for (const double sigma_mm : {0.0, 1.0, 2.0, 3.0, 4.0, 6.0, 10.0, 20.0}) {
    session.lights.front().distance_sigma = Metres(1e-3 * sigma_mm);
    const auto fitted = FitSession(session, {});
    EXPECT_TRUE(fitted.has_value()) << sigma_mm << " mm: " << fitted.error().message;
  }
}

TEST(ReadByAngle, WhatHasNoAxisOrTwoIsRefused) {
  for (const LightKind kind : {LightKind::kDirectional, LightKind::kTube}) {
    LightDescription light;
    light.name = "lamp";
    light.kind = kind;
    if (kind == LightKind::kTube) light.length = Metres(1.2);
    Session session = SessionOf(light);
    session.readings.push_back(ReadingAt(2.0, 30.0, 100.0));
    const auto fitted = FitSession(session, {});
    ASSERT_FALSE(fitted.has_value());
    EXPECT_EQ(fitted.error().code, "no_axis");
  }
}

TEST(ReadByAngle, BehindALampIsNoReadingOfIt) {
  Session session = SessionOf(AimedTwin(LightKind::kRect).light);
  session.readings.push_back(ReadingAt(2.0, 120.0, 100.0));
  const auto fitted = FitSession(session, {});
  ASSERT_FALSE(fitted.has_value());
  EXPECT_EQ(fitted.error().code, "no_valid_readings");
}

// A bulb's 100 lx at 60 degrees are its 100 lx at 0, a panel's 200: who does not say which has to
// read there.
TEST(ReadByAngle, OneAngleDoesNotTellABulbFromABeam) {
  for (const std::optional<Fixture> fixture :
       {std::optional<Fixture>(), std::optional(Fixture::kPanel)}) {
    LightDescription light;
    light.name = "lamp";
    light.fixture = fixture;
    Session session = SessionOf(light);
    session.readings = {ReadingAt(2.0, 60.0, 100.0), ReadingAt(2.0, -60.0, 100.0)};
    const auto fitted = FitSession(session, {});
    ASSERT_FALSE(fitted.has_value());
    EXPECT_EQ(fitted.error().code, "beam_unknown");
    EXPECT_NE(fitted.error().message.find("at 0 degrees"), std::string::npos);
  }
  LightDescription bulb;
  bulb.name = "lamp";
  bulb.fixture = Fixture::kBulb;
  Session session = SessionOf(bulb);
  session.readings = {ReadingAt(2.0, 60.0, 100.0)};
  const auto fitted = FitSession(session, {});
  ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
  EXPECT_NEAR(fitted->lights.lights.front().intensity_cd->value, 400.0, 4.0);
}

}  // namespace
}  // namespace lightcal
