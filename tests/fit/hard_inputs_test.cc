// SPDX-License-Identifier: Apache-2.0
// Rows F01-F33 of the numerically hard inputs that concern the photometric fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "fitted.h"
#include "lamp_twin.h"
#include "lightcal/fit/fit_light.h"
#include "warning_codes.h"

namespace lightcal {
namespace {

using test::Codes;
using test::FitOk;
using test::TypedSession;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Result<FittedSession> Fit(const Session& session) { return FitSession(session, FitSettings{}); }

Error FitRefused(const Session& session) {
  auto fitted = Fit(session);
  EXPECT_FALSE(fitted.has_value());
  return fitted ? Error{} : fitted.error();
}

TEST(HardInputs, F01TwoReadingsAtOneDistanceTellTheIntensityOnly) {
  const FittedLight light = FitOk(TypedSession({{0.5, 190.0}, {0.5, 194.0}}));
  EXPECT_NEAR(light.intensity_cd->value, 0.25 * std::sqrt(190.0 * 194.0), 1e-9);
  EXPECT_THAT(light.fit.learned, ElementsAre("intensity"));
  EXPECT_THAT(light.fit.prior, ElementsAre("distance_offset", "ambient"));
}

TEST(HardInputs, F02OneReadingAnswersWithAWideInterval) {
  const FittedLight light = FitOk(TypedSession({{0.5, 192.0}}));
  EXPECT_NEAR(light.intensity_cd->value, 48.0, 1e-12);
  // ln I: 5 % of the reading and twice a bulb's 3 cm at half a metre.
  const double sd = std::hypot(0.05, 0.12);
  EXPECT_NEAR(std::log(*light.intensity_cd->high / 48.0), kZ95 * sd, 0.005);
  EXPECT_THAT(light.fit.prior, ElementsAre("distance_offset", "ambient"));
  EXPECT_FALSE(light.fit.rms_relative.has_value());
  EXPECT_FALSE(light.fit.chi2_dof.has_value());
  EXPECT_EQ(light.fit.degrees_of_freedom, 0);
}

TEST(HardInputs, F03NoReadingsAreRefused) {
  EXPECT_EQ(FitRefused(TypedSession({})).code, "no_readings");
}

TEST(HardInputs, F04OnlyDuplicateDistancesGiveTheMean) {
  const FittedLight light = FitOk(TypedSession({{2, 10}, {2, 10.2}, {2, 9.9}, {2, 10.1}}));
  EXPECT_NEAR(light.intensity_cd->value, 4.0 * std::pow(10 * 10.2 * 9.9 * 10.1, 0.25), 1e-9);
  EXPECT_THAT(light.fit.prior, Contains("distance_offset"));
}

TEST(HardInputs, F05CloseDistancesLeaveThePriorsInCharge) {
  const FittedLight light = FitOk(TypedSession({{1, 100}, {1.05, 91.2}, {1.1, 82.1}}));
  EXPECT_LT(light.intensity_cd->u95 / light.intensity_cd->value, 0.7);
  EXPECT_THAT(light.fit.prior, Contains("distance_offset"));
}

TEST(HardInputs, F09AReadingOfZeroIsUsedAsItIs) {
  const FittedLight light = FitOk(TypedSession({{0.5, 400}, {1, 100}, {20, 0}}));
  EXPECT_NEAR(light.intensity_cd->value, 100.0, 5.0);
  EXPECT_EQ(light.fit.used, 3);
}

TEST(HardInputs, F10ALampLostInTheAmbientLightGetsAnUpperLimit) {
  Session session = TypedSession({{1.0, 100.0}}, 0.02);
  session.readings.push_back(session.readings.front());
  session.readings.back().reading.shadow_card = true;
  session.readings.back().reading.illuminance = Lux(101.0);
  auto fitted = Fit(session);
  ASSERT_TRUE(fitted.has_value());
  EXPECT_THAT(Codes(fitted->warnings), Contains("upper_limit"));
  const Uncertain& limit = *fitted->lights.lights.front().intensity_cd;
  EXPECT_EQ(*limit.low, 0.0);
  // Behind the card a minute later: what else shines may have drifted by .75 % of it.
  const double drifted = 0.0075 * 101.0;
  EXPECT_NEAR(*limit.high, kZ95 * std::hypot(2.0 * std::sqrt(1.0 + 1.01 * 1.01), drifted), 0.01);
}

TEST(HardInputs, F11AReadingThatIsNotANumberIsRejectedAndCounted) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto fitted = Fit(TypedSession({{0.5, 192}, {1.0, bad}}));
    ASSERT_TRUE(fitted.has_value());
    EXPECT_THAT(fitted->lights.lights.front().fit.rejected, ElementsAre(1));
    EXPECT_THAT(Codes(fitted->warnings), Contains("row_rejected"));
    EXPECT_EQ(FitRefused(TypedSession({{1.0, bad}})).code, "no_valid_readings");
  }
}

TEST(HardInputs, F12ADistanceOfZeroIsRejected) {
  const FittedLight light = FitOk(TypedSession({{0.5, 192}, {0.0, 5000}}));
  EXPECT_THAT(light.fit.rejected, ElementsAre(1));
  EXPECT_NEAR(light.intensity_cd->value, 48.0, 1e-12);
}

TEST(HardInputs, F13ANegativeDistanceIsRefused) {
  EXPECT_EQ(FitRefused(TypedSession({{0.5, 192}, {-1.0, 48}})).code, "negative_distance");
}

TEST(HardInputs, F14AMeterInsideTheLampIsRejected) {
  Session session = TypedSession({{0.5, 192}, {1e-6, 1e5}});
  session.lights.front().kind = LightKind::kSphere;
  session.lights.front().diameter = Metres(0.2);
  EXPECT_THAT(FitOk(session).fit.rejected, ElementsAre(1));
}

TEST(HardInputs, AToleranceOrASigmaThatIsNoPartIsRefused) {
  const Session session = TypedSession({{1, 100}});
  const FittedLight light = FitOk(session);
  EXPECT_TRUE(PredictIlluminance(light, Metres(2.0), 0.0).has_value());
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto fitted = FitSession(session, FitSettings{.tolerance_relative = bad});
    ASSERT_FALSE(fitted.has_value()) << bad;
    EXPECT_EQ(fitted.error().code, "bad_tolerance");
    const auto predicted = PredictIlluminance(light, Metres(2.0), bad);
    ASSERT_FALSE(predicted.has_value()) << bad;
    EXPECT_EQ(predicted.error().code, "bad_sigma");
    EXPECT_FALSE(PredictInRoom(light, Metres(2.0), bad).has_value()) << bad;
  }
}

TEST(HardInputs, F15MixedCentimetresAreNamed) {
  const Error error =
      FitRefused(TypedSession({{0.5, 192}, {1, 48}, {2, 12}, {150, 21.3}, {300, 5.3}}));
  EXPECT_EQ(error.code, "units_ambiguous");
  EXPECT_EQ(error.kind, ErrorKind::kRefused);
  EXPECT_THAT(error.message, HasSubstr("readings 3 and 4"));
  EXPECT_THAT(error.message, HasSubstr("cm"));
}

TEST(HardInputs, F16FeetOrFootcandlesAreAskedAbout) {
  EXPECT_EQ(FitRefused(TypedSession({{0.5, 192}, {1, 48}, {2, 12.0 / 10.764}})).code,
            "units_ambiguous");
  EXPECT_EQ(FitRefused(TypedSession({{0.5, 192}, {1 / 0.3048, 48}, {2, 12}})).code,
            "units_ambiguous");
  // A factor of 100 is as suspect.
  EXPECT_EQ(FitRefused(TypedSession({{0.5, 192}, {1, 4800}, {2, 12}})).code, "units_ambiguous");
}

TEST(HardInputs, F17AmbientAHundredTimesTheLampLeavesAWideInterval) {
  // 0.1 % repeatability, E0/E = 100: u of the difference is 0.1 % sqrt(101^2 + 100^2) = 14 %.
  // Both in one second: no daylight drifts between them.
  Session session = TypedSession({{1.0, 101.0}}, 0.001);
  session.readings.front().reading.time = "2026-03-01T10:00:00Z";
  session.readings.push_back(session.readings.front());
  session.readings.back().reading.shadow_card = true;
  session.readings.back().reading.illuminance = Lux(100.0);
  const FittedLight light = FitOk(session);
  EXPECT_NEAR(light.intensity_cd->value, 1.0, 1e-9);
  EXPECT_GE(light.intensity_cd->u95 / kZ95, 0.14);
}

TEST(HardInputs, F18LightThatGrowsWithDistanceIsRefused) {
  EXPECT_EQ(FitRefused(TypedSession({{0.5, 100}, {1, 200}, {2, 390}})).code,
            "increasing_with_distance");
  EXPECT_EQ(FitRefused(TypedSession({{0.5, 100}, {1, 98}, {2, 97}}, 0.02)).code, "model_misfit")
      << "no lamp in the open does that";
  EXPECT_EQ(FitRefused(TypedSession({{1, 100}, {2, 90}}, 0.04)).code, "model_misfit")
      << "nor 17 m behind its glass";
}

TEST(HardInputs, F19PerfectReadingsStillHaveAnUncertainty) {
  const FittedLight light = FitOk(TypedSession({{0.5, 400}, {1, 100}, {2, 25}, {4, 6.25}}, 0.02));
  EXPECT_NEAR(light.intensity_cd->value, 100.0, 1e-6);
  EXPECT_GT(light.intensity_cd->u95, 1.0);
  EXPECT_NEAR(*light.fit.chi2_dof, 0.0, 1e-12);
}

TEST(HardInputs, F20FaintAndFierceLampsAreFittedAlike) {
  const std::vector<test::TypedReading> readings = {{0.5, 410}, {1, 99}, {2, 25.3}, {4, 6.2}};
  const FittedLight light = FitOk(TypedSession(readings, 0.02));
  for (const double factor : {1e-8, 1e10}) {
    std::vector<test::TypedReading> scaled = readings;
    for (auto& r : scaled) r.illuminance_lx *= factor;
    const FittedLight other = FitOk(TypedSession(scaled, 0.02));
    EXPECT_NEAR(other.intensity_cd->value / (factor * light.intensity_cd->value), 1.0, 1e-10);
  }
}

TEST(HardInputs, F21AnOffsetAtItsBoundIsSaid) {
  // Closer to 1/d^6 than to 1/d^2: no offset explains it.
  EXPECT_EQ(
      FitRefused(TypedSession({{1, 1000}, {1.2, 330}, {1.5, 90}, {2, 16}, {3, 1.4}}, 0.001)).code,
      "model_misfit");
}

TEST(HardInputs, F23AmbientAtZeroHasAOneSidedInterval) {
  const FittedLight light = FitOk(TypedSession({{0.5, 400}, {1, 100}, {2, 25}, {4, 6.2}}, 0.02));
  EXPECT_EQ(*light.ambient_lx->low, 0.0);
  EXPECT_GT(*light.ambient_lx->high, 0.0);
  EXPECT_GE(light.ambient_lx->value, 0.0);
}

TEST(HardInputs, F24ManyReadingsEqualTheirMean) {
  std::vector<test::TypedReading> few;
  std::vector<test::TypedReading> many;
  for (const double d : {0.5, 1.0, 2.0}) {
    few.push_back({d, 100.0 / (d * d) * (1.0 + 0.01 * d)});
    for (int i = 0; i < 20000; ++i) many.push_back(few.back());
  }
  const double few_sigma = 0.02 / std::sqrt(20000.0);
  const FittedLight a = FitOk(TypedSession(few, few_sigma));
  const FittedLight b = FitOk(TypedSession(many, 0.02));
  EXPECT_NEAR(b.intensity_cd->value / a.intensity_cd->value, 1.0, 1e-9);
  EXPECT_NEAR(b.fit.used, 60000, 0);
}

TEST(HardInputs, F25WeightsOfAnySpanAreSolved) {
  Session session = TypedSession({{0.5, 400}, {1, 100.5}, {2, 25}, {4, 6.3}}, 0.02);
  session.lights.front().distance_sigma = Metres(0.0);  // or it would be the least sigma
  session.readings[1].reading.sigma_relative = 1e-4;
  session.readings[3].reading.sigma_relative = 0.25;
  const FittedLight light = FitOk(session);
  EXPECT_TRUE(std::isfinite(light.intensity_cd->u95));
  const double near_one =
      light.intensity_cd->value / std::pow(1.0 + light.distance_offset_m->value, 2) +
      light.ambient_lx->value;
  EXPECT_NEAR(near_one, 100.5, 0.03);
}

TEST(HardInputs, F26ASigmaOfNextToNothingDoesNotMakeCertainty) {
  const FittedLight light = FitOk(TypedSession({{1, 100}, {1, 100}, {1, 100}}, 1e-12));
  EXPECT_GT(light.intensity_cd->u95, 0.0);
  EXPECT_TRUE(std::isfinite(light.intensity_cd->u95));
  EXPECT_EQ(FitRefused(TypedSession({{1, 100}}, 0.0)).code, "no_valid_readings");
}

// A session made by a program obeys what one of a file does.
struct Impossible {
  const char* name;
  void (*make)(Session& session, LightDescription& light, Reading& reading);
  const char* code;
  const char* says;
};
void PrintTo(const Impossible& one, std::ostream* out) { *out << one.name; }
class ImpossibleSession : public testing::TestWithParam<Impossible> {};

TEST_P(ImpossibleSession, IsRefusedBeforeAnythingIsFitted) {
  Session session = TypedSession({{1.0, 100.0}}, 0.05);
  GetParam().make(session, session.lights.front(), session.readings.front().reading);
  const Error error = FitRefused(session);
  EXPECT_EQ(error.kind, ErrorKind::kRefused);
  EXPECT_EQ(error.code, GetParam().code);
  EXPECT_THAT(error.message, HasSubstr(GetParam().says));
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Impossible kImpossible[] = {
    {"Meter", [](Session&, LightDescription&, Reading& r) { r.meter = "nope"; }, "unknown_meter",
     "nope"},
    {"OffAxis", [](Session&, LightDescription&, Reading& r) { r.off_axis = Radians(kNan); },
     "no_valid_readings", "off_axis_deg"},
    {"Tilt", [](Session&, LightDescription&, Reading& r) { r.tilt = Radians(kNan); },
     "no_valid_readings", "tilt_deg"},
    {"NoSigma", [](Session&, LightDescription&, Reading& r) { r.sigma_relative = 0.0; },
     "no_valid_readings", "sigma_relative = 0"},
    {"SigmaBelow0", [](Session&, LightDescription&, Reading& r) { r.sigma_relative = -0.1; },
     "no_valid_readings", "sigma_relative"},
    {"SigmaNan", [](Session&, LightDescription&, Reading& r) { r.sigma_relative = kNan; },
     "no_valid_readings", "sigma_relative"},
    {"DarkBelow0", [](Session&, LightDescription&, Reading& r) { r.illuminance = Lux(-1.0); },
     "no_valid_readings", "illuminance_lx"},
    {"Reflectance", [](Session& s, LightDescription&, Reading&) { s.room = Room{{5, 4, 2}, 1.5}; },
     "bad_session", "reflectance = 1.5"},
    {"RoomNan", [](Session& s, LightDescription&, Reading&) { s.room = Room{{kNan, 4, 2}}; },
     "bad_session", "size_m = nan"},
    {"RoomOfNothing", [](Session& s, LightDescription&, Reading&) { s.room = Room{}; },
     "bad_session", "size_m = 0"},
    {"Diameter", [](Session&, LightDescription& l, Reading&) { l.diameter = Metres(-1.0); },
     "bad_session", "diameter_m = -1"},
    {"DiameterNan", [](Session&, LightDescription& l, Reading&) { l.diameter = Metres(kNan); },
     "bad_session", "diameter_m = nan"},
    {"LongAim", [](Session&, LightDescription& l, Reading&) { l.aim = Vec3{0, 0, -2}; },
     "bad_session", "aim must be a direction of length 1"},
    {"TwoOfOneName",
     [](Session& s, LightDescription&, Reading&) { s.lights.push_back(s.lights.front()); },
     "duplicate_name", "described twice"},
    {"FartherThanAnything",
     [](Session&, LightDescription&, Reading& r) {
       r.distance = Metres(1e308);
       r.illuminance = Lux(0.0);
     },
     "out_of_range", "no number can hold"},
};
INSTANTIATE_TEST_SUITE_P(HardInputs, ImpossibleSession, testing::ValuesIn(kImpossible),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(HardInputs, AHalfAngleOfAHalfTurnIsOne) {
  Session session = TypedSession({{1.0, 100.0}}, 0.05);
  session.lights.front().outer = RadiansFromDegrees(180.0);
  session.lights.front().beam = RadiansFromDegrees(360.0);
  EXPECT_TRUE(CheckSession(session).has_value());
}

TEST(HardInputs, F27AnOverRangeReadingIsALowerLimit) {
  Session session = TypedSession({{0.25, 1000}, {1, 100}, {2, 25}});
  session.readings.front().reading.over_range = true;  // the truth is 1600 lx
  EXPECT_NEAR(FitOk(session).intensity_cd->value, 100.0, 1.0);
  Session only = TypedSession({{0.25, 1000}});
  only.readings.front().reading.over_range = true;
  EXPECT_EQ(FitRefused(only).code, "over_range");
}

// The lamp-off reading that a meter shows as 0.0 or "under": ambient light of at most its last
// digit.
TEST(HardInputs, AnUnderRangeReadingIsAnUpperLimit) {
  Session session = TypedSession({{0.5, 400}, {1, 100}, {2, 25}, {2, 0.2}});
  Reading& dark = session.readings.back().reading;
  dark.lamp = LampState::kOff;
  dark.under_range = true;
  const FittedLight light = FitOk(session);
  EXPECT_NEAR(light.intensity_cd->value, 100.0, 1.0);
  EXPECT_NEAR(light.ambient_lx->value, 0.1, 0.1);
  Session far = TypedSession({{0.5, 400}, {1, 100}, {20, 0.5}});
  far.readings.back().reading.under_range = true;  // the truth is 0.25 lx
  EXPECT_NEAR(FitOk(far).intensity_cd->value, 100.0, 1.0);
}

TEST(HardInputs, F32AGrazingMeterIsRejectedAndAnAlmostGrazingOneSaysLittle) {
  Session edge = TypedSession({{0.5, 192}});
  edge.readings.front().reading.tilt = RadiansFromDegrees(90.0);
  EXPECT_EQ(FitRefused(edge).code, "no_valid_readings");
  Session slant = TypedSession({{0.5, 192}, {0.5, 5.0}}, 0.02);
  slant.readings.back().reading.tilt = RadiansFromDegrees(89.9);
  // 5 lx at 89.9 degrees would be 700 cd; a degree of pointing makes it worthless.
  EXPECT_NEAR(FitOk(slant).intensity_cd->value, 48.0, 3.0);
}

TEST(HardInputs, F33AMeterFacingAwayIsRejected) {
  Session session = TypedSession({{0.5, 192}, {1.0, 48}});
  session.readings.back().reading.tilt = RadiansFromDegrees(120.0);
  EXPECT_THAT(FitOk(session).fit.rejected, ElementsAre(1));
}

TEST(HardInputs, AnUnknownPositionIsRefusedAndAKnownOneGivesDistanceAndTilt) {
  Session session = TypedSession({{1, 0}});
  Reading& reading = session.readings.front().reading;
  reading.distance.reset();
  reading.position_m = Vec3{1.0, 0.0, 0.0};
  reading.normal = Vec3{0.0, 0.0, 1.0};
  reading.illuminance = Lux(48.0 * std::cos(std::numbers::pi / 4.0) / 2.0);
  EXPECT_EQ(FitRefused(session).code, "position_unknown");
  session.lights.front().position_m = Vec3{0.0, 0.0, 1.0};
  EXPECT_NEAR(FitOk(session).intensity_cd->value, 48.0, 1e-9);
}

}  // namespace
}  // namespace lightcal
