// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/fit_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fitted.h"
#include "lamp_twin.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/starts.h"

namespace lightcal {
namespace {

using test::Effect;
using test::FitOk;
using test::LampTruth;
using test::TwinSession;
using test::TypedSession;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

using std::numbers::pi;

TEST(FitLight, RecoversATruthWithoutNoise) {
  const LampTruth truth{320.0, 0.04, 1.5, 0.0, 0.0};
  TwinSession twin(truth, 0.0, 1);
  twin.On({0.5, 1, 2, 4}).Off();
  for (SessionReading& row : twin.session().readings) row.reading.sigma_relative = 0.001;
  const FittedLight light = FitOk(twin.session());
  EXPECT_NEAR(light.intensity_cd->value, 320.0, 0.1);
  EXPECT_NEAR(light.distance_offset_m->value, 0.04, 1e-4);
  EXPECT_NEAR(light.ambient_lx->value, 1.5, 1e-3);
  EXPECT_THAT(light.fit.learned, testing::ElementsAre("intensity", "distance_offset", "ambient"));
}

TEST(FitLight, OffReadingsTakeAmbientLightOut) {
  const LampTruth truth{100.0, 0.0, 5.0, 0.0, 0.0};
  TwinSession with(truth, 0.0, 1);
  with.On({0.5, 1, 2}).Off().Off();
  TwinSession without(truth, 0.0, 1);
  without.On({0.5, 1, 2});
  EXPECT_NEAR(FitOk(with.session()).intensity_cd->value, 100.0, 1.0);
  const auto left = FitSession(without.session(), FitSettings{});
  ASSERT_TRUE(left.has_value());
  const Uncertain& found = *left->lights.lights.front().intensity_cd;
  EXPECT_GT(std::abs(found.value - 100.0), 2.0);
  EXPECT_TRUE(std::ranges::any_of(left->warnings, [](const Warning& w) {
    return w.code == "misfit";
  })) << "5 lx of 30 beside sigmas of nothing";
}

TEST(FitLight, ShadowCardsTakeBounceOutWhereOffReadingsCannot) {
  const LampTruth truth{100.0, 0.0, 2.0, 4.0, 0.0};
  TwinSession off(truth, 0.0, 1);
  off.session().lights.front().fixture = Fixture::kBulb;
  off.On(1.0).Off();
  EXPECT_NEAR(FitOk(off.session()).intensity_cd->value, 104.0, 1e-6);
  TwinSession card(truth, 0.0, 1);
  card.session().lights.front().fixture = Fixture::kBulb;
  card.On(1.0).ShadowCard(1.0);
  const FittedLight light = FitOk(card.session());
  EXPECT_NEAR(light.intensity_cd->value, 100.0, 1e-9);
  EXPECT_EQ(light.fit.used, 2);
  EXPECT_NEAR(light.residuals.front().measured_lx, 100.0, 1e-9);
}

TEST(FitLight, IsInvariantToTheScaleOfLightAndLength) {
  fit::Observations observations;
  const std::vector<double> distances = {0.5, 0.9, 1.6, 2.4, 4.0};
  TwinSession twin(LampTruth{}, 0.02, 17);
  twin.On(distances);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    fit::Observation row;
    row.index = static_cast<int>(i);
    row.distance_m = distances[i];
    row.measured_lx = row.raw_lx = twin.session().readings[i].reading.illuminance->value();
    row.sigma_lx = 0.02 * row.raw_lx;
    observations.rows.push_back(row);
  }
  observations.readings = 5;
  const auto reference = fit::EstimateLight(observations, fit::ForwardModel{}, "lamp");
  ASSERT_TRUE(reference.has_value());
  for (const double light : {1e-7, 1.0, 3e9}) {
    for (const double length : {1e-3, 1.0, 7e4}) {
      fit::Observations scaled = observations;
      for (fit::Observation& row : scaled.rows) {
        row.distance_m *= length;
        row.measured_lx *= light;
        row.raw_lx *= light;
        row.sigma_lx *= light;
      }
      const auto other = fit::EstimateLight(scaled, fit::ForwardModel{}, "lamp");
      ASSERT_TRUE(other.has_value());
      const double expected = reference->theta[0] + std::log(light) + 2.0 * std::log(length);
      EXPECT_NEAR(std::exp(other->theta[0] - expected), 1.0, 1e-12);
      EXPECT_NEAR(other->theta[1] / (length * reference->theta[1]), 1.0, 1e-10);
      EXPECT_NEAR(other->covariance[0] / reference->covariance[0], 1.0, 1e-10);
    }
  }
}

TEST(Solve, F22EndsAtOneOptimumFromManyStarts) {
  fit::Estimation estimation;
  for (const double d : {0.4, 0.8, 1.6, 3.2}) {
    fit::ReadingRow row;
    row.distance = d;
    row.measured = 1.0 / ((d + 0.03) * (d + 0.03)) * (1.0 + 0.01 * std::sin(9.0 * d));
    row.sigma = 0.01;
    estimation.rows.push_back(row);
  }
  estimation.rules[fit::kLnIntensity].free = true;
  estimation.rules[fit::kDistanceOffset] = {true, 0.0, 0.06};
  estimation.least_distance_offset = -0.36;
  const auto best = fit::Solve(estimation, fit::ClosedFormStart(estimation, 0.0));
  ASSERT_TRUE(best.has_value());
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 100; ++i) {
    const fit::Theta start = {6.0 * uniform(random) - 3.0, 1.36 * uniform(random) - 0.355, 0.0};
    const auto other = fit::Solve(estimation, start);
    ASSERT_TRUE(other.has_value());
    EXPECT_NEAR((*other)[0], (*best)[0], 1e-8);
    EXPECT_NEAR((*other)[1], (*best)[1], 1e-8);
  }
}

TEST(FitLight, ClosedFormAloneIsWithinAPercentOfTheFit) {
  fit::Estimation estimation;
  for (const double d : {0.5, 1.0, 2.0}) {
    fit::ReadingRow row;
    row.distance = d;
    row.measured = 7.0 / ((d + 0.05) * (d + 0.05));
    row.sigma = 0.02;
    estimation.rows.push_back(row);
  }
  estimation.rules[fit::kLnIntensity].free = true;
  estimation.rules[fit::kDistanceOffset].free = true;  // no prior: exact
  estimation.least_distance_offset = -0.45;
  const fit::Theta start = fit::ClosedFormStart(estimation, 0.0);
  EXPECT_NEAR(std::exp(start[0]), 7.0, 1e-9);
  EXPECT_NEAR(start[1], 0.05, 1e-10);
}

TEST(FitLight, AnOffsetBeyondItsPriorWidensItAndSaysSo) {
  const LampTruth truth{500.0, 0.45, 0.0, 0.0, 0.0};
  TwinSession twin(truth, 0.001, 2);
  twin.On({1, 2, 3});
  auto fitted = FitSession(twin.session(), FitSettings{});
  ASSERT_TRUE(fitted.has_value());
  EXPECT_TRUE(std::any_of(fitted->warnings.begin(), fitted->warnings.end(),
                          [](const Warning& w) { return w.code == "prior_conflict"; }));
  EXPECT_NEAR(fitted->lights.lights.front().distance_offset_m->value, 0.45, 0.02);
}

TEST(FitLight, ATiltedMeterIsCorrectedByItsCosine) {
  Session session = TypedSession({{0.5, 96.0}});
  session.readings.front().reading.tilt = RadiansFromDegrees(60.0);
  const FittedLight light = FitOk(session);
  EXPECT_NEAR(light.intensity_cd->value, 48.0, 1e-9);
  EXPECT_EQ(Effect(light, "meter_tilt").state, EffectState::kOn);
  EXPECT_NEAR(*Effect(light, "meter_tilt").contribution, -0.5, 1e-12);
  FitSettings naive;
  naive.effects = "-meter_tilt";
  EXPECT_NEAR(FitOk(session, naive).intensity_cd->value, 24.0, 1e-9);
}

TEST(FitLight, ANearDiskIsFittedInItsExactForm) {
  // E = pi L R^2/(R^2 + d^2) with L = 5000 cd/m^2, R = 0.2 m.
  Session session;
  std::vector<test::TypedReading> readings;
  for (const double d : {0.4, 0.8, 1.6}) {
    readings.push_back({d, pi * 5000.0 * 0.04 / (0.04 + d * d)});
  }
  session = TypedSession(readings, 0.005);
  session.lights.front().kind = LightKind::kDisk;
  session.lights.front().diameter = Metres(0.4);
  const FittedLight light = FitOk(session);
  EXPECT_EQ(Effect(light, "finite_source").state, EffectState::kOn);
  EXPECT_NEAR(light.luminance_nits->value, 5000.0, 1e-3);
  EXPECT_NEAR(light.flux_lm->value, pi * pi * 5000.0 * 0.04, 1e-3);
  EXPECT_NEAR(light.distance_offset_m->value, 0.0, 1e-6);
  auto near = PredictIlluminance(light, Metres(0.2), 0.0);
  ASSERT_TRUE(near.has_value());
  EXPECT_NEAR(near->model_lx.value, pi * 5000.0 * 0.5, 1.0);
}

TEST(FitLight, AKnownRoomLowersTheIntensityByItsBounce) {
  Session session = TypedSession({{1.0, 100.0}});
  const FittedLight open = FitOk(session);
  session.surroundings = Surroundings::kIndoors;
  session.room = Room{{5.0, 4.0, 2.6}, 0.5};
  const FittedLight inside = FitOk(session);
  const EffectReport& bounce = Effect(inside, "room_bounce");
  EXPECT_EQ(bounce.state, EffectState::kFitted);
  // In the likeliest place; near a wall more is thrown back.
  const auto place = std::ranges::max_element(inside.in_room, {}, &LampInRoom::weight);
  EXPECT_NEAR(std::exp(place->ln_intensity) * (1.0 + *bounce.contribution), 100.0, 0.1);
  EXPECT_LT(inside.intensity_cd->value, std::exp(place->ln_intensity));
  EXPECT_LT(inside.intensity_cd->value, 0.9 * open.intensity_cd->value);
  EXPECT_GT(*inside.intensity_cd->high, open.intensity_cd->value * 0.9);
  EXPECT_TRUE(std::ranges::none_of(open.effects,
                                   [](const EffectReport& e) { return e.name == "room_bounce"; }));
}

TEST(FitLight, DirectionalAndDomeLightsHaveIlluminanceAlone) {
  for (const LightKind kind : {LightKind::kDirectional, LightKind::kDome}) {
    Session session = TypedSession({{1, 90000.0}, {7, 92000.0}}, 0.03);
    session.lights.front().kind = kind;
    const FittedLight light = FitOk(session);
    EXPECT_FALSE(light.intensity_cd.has_value());
    EXPECT_FALSE(light.distance_offset_m.has_value());
    EXPECT_NEAR(light.illuminance_lx->value, std::sqrt(90000.0 * 92000.0), 1e-6);
    EXPECT_THAT(light.fit.learned, testing::ElementsAre("illuminance"));
  }
}

TEST(FitLight, EachKindIntegratesItsOwnFlux) {
  Session session = TypedSession({{1.0, 100.0}});
  EXPECT_NEAR(FitOk(session).flux_lm->value, 400.0 * pi, 1e-9);
  session.lights.front().kind = LightKind::kSpot;
  EXPECT_FALSE(FitOk(session).flux_lm.has_value());
  session.lights.front().inner = RadiansFromDegrees(20.0);
  session.lights.front().outer = RadiansFromDegrees(35.0);
  const double ci = std::cos(20.0 * pi / 180.0);
  const double co = std::cos(35.0 * pi / 180.0);
  EXPECT_NEAR(FitOk(session).flux_lm->value, 100.0 * 2.0 * pi * ((1.0 - ci) + (ci - co) / 3.0),
              1e-9);
}

TEST(FitLight, AReadingWithoutAPlaceHasNoDistanceInItsResidual) {
  Session session = TypedSession({{1.0, 100.0}});
  session.lights.front().kind = LightKind::kDirectional;
  EXPECT_TRUE(FitOk(session).residuals.front().distance_m.has_value());
  session.readings.front().reading.distance.reset();
  EXPECT_FALSE(FitOk(session).residuals.front().distance_m.has_value());
}

TEST(FitLight, ADataSheetAloneAnswersAsAPrior) {
  Session session = TypedSession({});
  session.lights.front().flux = Lumens(806.0);
  session.lights.front().beam = RadiansFromDegrees(36.0);
  const FittedLight light = FitOk(session);
  // From two thirds of 806 lm in a cos^n lobe, n = ln .5/ln cos 18 deg (1266 cd), to a uniform
  // cone, 806/(2 pi (1 - cos 18 deg)) (2621 cd); the printed flux's own tenth in quadrature.
  const double half = std::hypot(0.5 * std::log(2621.0 / 1266.0), std::log(1.1));
  EXPECT_NEAR(*light.intensity_cd->low, std::sqrt(1266.0 * 2621.0) * std::exp(-half), 5.0);
  EXPECT_NEAR(*light.intensity_cd->high, std::sqrt(1266.0 * 2621.0) * std::exp(half), 5.0);
  EXPECT_TRUE(light.fit.learned.empty());
  EXPECT_THAT(light.fit.prior, Contains("intensity"));
  EXPECT_THAT(NextStep(session, light), HasSubstr("measure"));
}

TEST(FitLight, AReadingFarFromTheDataSheetIsSaid) {
  Session session = TypedSession({{1.0, 100.0}});
  session.lights.front().flux = Lumens(1250.0);
  const auto codes = [&] {
    std::vector<std::string> out;
    const auto fitted = FitSession(session, {});
    for (const Warning& w : fitted.value().warnings) out.push_back(w.code);
    return out;
  };
  EXPECT_THAT(codes(), Not(Contains("data_sheet_disagrees")));
  session.lights.front().flux = Lumens(12500.0);
  EXPECT_THAT(codes(), Contains("data_sheet_disagrees"));
}

// Of which setting the box speaks nobody says.
TEST(FitLight, ADataSheetSaysNothingOfALampReadAtItsControls) {
  Session session = TypedSession({{1.0, 100.0}});
  const double read = FitOk(session).intensity_cd->u95;
  session.lights.front().flux = Lumens(1250.0);
  EXPECT_LT(FitOk(session).intensity_cd->u95, 0.9 * read);
  session.readings.front().reading.state = {{"dimmer", 50.0}};
  EXPECT_NEAR(FitOk(session).intensity_cd->u95, read, 1e-9 * read);
}

TEST(FitLight, ALightWithoutReadingsIsNamedBesideOthersThatHaveThem) {
  Session session = TypedSession({{1.0, 100.0}});
  session.lights.emplace_back();
  session.lights.back().name = "never read";
  auto fitted = FitSession(session, {});
  ASSERT_TRUE(fitted.has_value());
  EXPECT_EQ(fitted->lights.lights.size(), 1U);
  ASSERT_EQ(fitted->warnings.size(), 1U);
  EXPECT_EQ(fitted->warnings.front().subject, "never read");
}

TEST(PredictIlluminance, RefusesAPointInsideTheLamp) {
  const FittedLight light = FitOk(TypedSession({{0.5, 192.0}}));
  EXPECT_FALSE(PredictIlluminance(light, Metres(0.0), 0.05).has_value());
  EXPECT_FALSE(PredictIlluminance(light, Metres(-1.0), 0.05).has_value());
  // Where it was measured the prior of the offset cancels: the reading's own sigma is left.
  const auto there = PredictIlluminance(light, Metres(0.5), 0.0);
  ASSERT_TRUE(there.has_value());
  EXPECT_NEAR(there->model_lx.value, 192.0, 1e-9);
  EXPECT_NEAR(std::log(*there->model_lx.high / 192.0) / kZ95, 0.05, 0.001);
}

TEST(NextStep, AsksForAnotherReadingThenForAShadowCard) {
  const Session one = TypedSession({{0.5, 192.0}});
  EXPECT_THAT(NextStep(one, FitOk(one)), AllOf(HasSubstr("read at "), HasSubstr(" → ± ")));
  Session three = TypedSession({{0.5, 206.0}, {1, 61}, {2, 22}}, 0.02);
  three.surroundings = Surroundings::kIndoors;  // a bulb of 48 cd in an ordinary room
  EXPECT_THAT(NextStep(three, FitOk(three)), AllOf(HasSubstr("shadow-card"), HasSubstr(" → ± ")));
}

}  // namespace
}  // namespace lightcal
