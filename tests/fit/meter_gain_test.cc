// SPDX-License-Identifier: Apache-2.0
// What all readings of one meter share: its calibration; and what of it cancels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "fitted.h"
#include "lamp_twin.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/records/session_codec.h"

namespace lightcal {
namespace {

using test::FitOk;
using test::LampTruth;
using test::TwinSession;
using testing::HasSubstr;

const std::vector<double> kDistances = {0.5, 1.0, 2.0, 4.0};

// The same readings by a meter that shows everything `gain` times too high.
Session ByMeter(Session session, double gain, double repeatability, double calibration) {
  MeterDescription meter;
  meter.name = "m";
  meter.sigma_relative = std::hypot(repeatability, calibration);
  meter.calibration_relative = calibration;
  session.meters = {meter};
  for (SessionReading& row : session.readings) {
    row.reading.meter = "m";
    row.reading.sigma_relative.reset();
    row.reading.illuminance = *row.reading.illuminance * gain;
  }
  return session;
}

double RelativeSd(const Uncertain& u) { return std::log(*u.high / *u.low) / (2.0 * kZ95); }

TEST(MeterGain, NinetyFiveOfAHundredIntervalsHoldTheTruth) {
  constexpr int kTwins = 1000;
  constexpr double kRepeatability = 0.01;
  constexpr double kCalibration = 0.03;
  std::mt19937_64 random(20261122);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  int covered = 0;
  double z_squared = 0.0;
  for (int i = 0; i < kTwins; ++i) {
    LampTruth truth;
    truth.intensity_cd = std::exp(5.0 + 2.0 * normal(random));
    truth.offset_m = 0.15 * kDistances.front() * normal(random);
    truth.ambient_lx = 0.2 * uniform(random) * test::TrueDirect(truth, kDistances.back());
    TwinSession twin(truth, kRepeatability, random());
    twin.On(kDistances).Off().Off();
    const double gain = std::exp(kCalibration * normal(random));
    const FittedLight light = FitOk(ByMeter(twin.session(), gain, kRepeatability, kCalibration));
    const Uncertain& found = *light.intensity_cd;
    covered += truth.intensity_cd >= *found.low && truth.intensity_cd <= *found.high ? 1 : 0;
    const double z = std::log(truth.intensity_cd / found.value) / RelativeSd(found);
    z_squared += z * z;
  }
  EXPECT_GE(covered, 930);
  EXPECT_LE(covered, 970);
  EXPECT_NEAR(std::sqrt(z_squared / kTwins), 1.0, 0.1);
}

TEST(MeterGain, RepeatingNeverBringsTheIntervalBelowTheCalibration) {
  constexpr double kCalibration = 0.03;
  const auto sd_of = [](int repeats, double calibration) {
    TwinSession twin(LampTruth{}, 0.01, 17);
    for (int i = 0; i < repeats; ++i) twin.On(kDistances);
    twin.Off();
    return RelativeSd(*FitOk(ByMeter(twin.session(), 1.0, 0.01, calibration)).intensity_cd);
  };
  EXPECT_GT(sd_of(100, kCalibration), kCalibration);
  EXPECT_LT(sd_of(100, kCalibration), 1.1 * kCalibration);
  EXPECT_LT(sd_of(100, 0.0), 0.4 * sd_of(1, 0.0)) << "what is each reading's own averages away";
  const double apart = std::hypot(sd_of(1, 0.0), kCalibration);
  EXPECT_NEAR(sd_of(1, kCalibration), apart, 0.02 * apart) << "one factor, added after the fit";
}

TEST(MeterGain, AMeterThatStatesOneSigmaSharesItWithAllItsReadings) {
  Session session = ByMeter(TwinSession(LampTruth{}, 0.01, 1).On(1.0).session(), 1.0, 0.03, 0.04);
  const Reading& reading = session.readings.front().reading;
  EXPECT_NEAR(RepeatabilityRelative(session, reading), 0.03, 1e-12);
  session.meters.front().calibration_relative.reset();
  EXPECT_NEAR(CalibrationRelative(session, reading), 0.05, 1e-12);
  EXPECT_NEAR(RepeatabilityRelative(session, reading), 0.01, 1e-12) << "what no sigma says";
  session.meters.front().sigma_relative = 0.002;
  EXPECT_NEAR(RepeatabilityRelative(session, reading), 0.002, 1e-12) << "never above sigma";
  Reading own;
  own.sigma_relative = 0.02;
  EXPECT_EQ(CalibrationRelative(session, own), 0.0) << "written by hand: its own";
  own.device = "sekonic:1";
  EXPECT_GT(CalibrationRelative(session, own), 0.0) << "an instrument's";
  own.meter = kDataSheetMeter;
  EXPECT_EQ(CalibrationRelative(session, own), 0.0);
}

TEST(MeterGain, TwoMetersAverageTheirCalibrations) {
  TwinSession twin(LampTruth{}, 0.005, 5);
  for (int i = 0; i < 20; ++i) twin.On(kDistances);
  Session one = ByMeter(twin.session(), 1.0, 0.005, 0.04);
  Session two = one;
  two.meters.push_back(two.meters.front());
  two.meters.back().name = "n";
  for (std::size_t i = 0; i < two.readings.size(); i += 8) {
    for (std::size_t k = i; k < i + 4; ++k) two.readings[k].reading.meter = "n";
  }
  const double single = RelativeSd(*FitOk(one).intensity_cd);
  const double both = RelativeSd(*FitOk(two).intensity_cd);
  EXPECT_LT(both, 0.85 * single);
  EXPECT_GT(both, 0.65 * single);
}

// ---- several lamps, on and off ----

constexpr const char* kThreeLamps = R"(lightcal = 1
[room]
dark = true
[[light]]
name = "key"
kind = "point"
fixture = "bulb"
[[light]]
name = "fill"
kind = "point"
fixture = "bulb"
[[light]]
name = "rim"
kind = "point"
fixture = "bulb"
[[meter]]
name = "m"
sigma_relative = 0.0316
calibration_relative = 0.03
)";

struct Shown {
  std::string lit;
  double lux;
};

// At one mark: key 2 m away, fill 1.5 m, rim 3 m.
Session ReadAtTheMark(const std::vector<Shown>& shown) {
  std::string text = kThreeLamps;
  bool first = true;
  for (const Shown& one : shown) {
    text += "[[reading]]\nmeter = \"m\"\nlit = [" + one.lit + "]\n";
    text +=
        "distances_m = { fill = 1.5" + std::string(first ? ", key = 2.0, rim = 3.0" : "") + " }\n";
    text += "illuminance_lx = " + std::to_string(one.lux) + "\n";
    first = false;
  }
  const auto session = ParseSessionToml(text, "session.toml");
  EXPECT_TRUE(session.has_value()) << session.error().message;
  return session ? *session : Session{};
}

std::vector<double> Candelas(const Session& session) {
  const auto fitted = FitSession(session, {});
  EXPECT_TRUE(fitted.has_value()) << fitted.error().message;
  std::vector<double> out;
  if (!fitted) return out;
  for (const FittedLight& light : fitted->lights.lights) out.push_back(light.intensity_cd->value);
  return out;
}

// key 100 lx = 400 cd, fill 60 lx = 135 cd, rim 20 lx = 180 cd, everything else 30 lx.
const testing::Matcher<std::vector<double>> kTruth =
    testing::ElementsAre(testing::DoubleNear(400.0, 0.4), testing::DoubleNear(135.0, 0.2),
                         testing::DoubleNear(180.0, 0.2));

TEST(LitReadings, EachLampIsTheDifferenceOfItsSwitch) {
  EXPECT_THAT(Candelas(ReadAtTheMark({{R"("key", "fill", "rim")", 210},
                                      {R"("fill", "rim")", 110},
                                      {R"("key", "rim")", 150},
                                      {R"("key", "fill")", 190}})),
              kTruth);
}

TEST(LitReadings, SwitchedOffOneAfterTheOther) {
  EXPECT_THAT(Candelas(ReadAtTheMark({{R"("key", "fill", "rim")", 210},
                                      {R"("fill", "rim")", 110},
                                      {R"("rim")", 50},
                                      {"", 30}})),
              kTruth);
}

TEST(LitReadings, OneAtATimeSharesOneDarkReading) {
  EXPECT_THAT(
      Candelas(ReadAtTheMark({{R"("key")", 130}, {R"("fill")", 90}, {R"("rim")", 50}, {"", 30}})),
      testing::ElementsAre(testing::DoubleNear(400.0, 4), testing::DoubleNear(135.0, 2),
                           testing::DoubleNear(180.0, 4)));
}

TEST(LitReadings, LampsThatNeverPartAreRefused) {
  const auto fitted = FitSession(ReadAtTheMark({{R"("key", "fill")", 190}, {R"("rim")", 50}}), {});
  ASSERT_FALSE(fitted.has_value());
  EXPECT_EQ(fitted.error().code, "not_separated");
  EXPECT_THAT(fitted.error().message, HasSubstr("with it off"));
}

// Reference 4.8: at an ambient as bright as the lamp 1 % readings give the difference 2.2 %.
TEST(LitReadings, TheDifferenceCostsWhatItsTwoReadingsCost) {
  std::string text = kThreeLamps;
  text += "[[meter]]\nname = \"own\"\nsigma_relative = 0.01\ncalibration_relative = 0\n";
  for (const char* shown : {"lit = [\"key\", \"fill\"]\nilluminance_lx = 200\n",
                            "lit = [\"fill\"]\nilluminance_lx = 100\n"}) {
    text += "[[reading]]\nmeter = \"own\"\ndistances_m = { key = 2.0 }\n" + std::string(shown);
  }
  auto session = ParseSessionToml(text, "session.toml");
  ASSERT_TRUE(session.has_value()) << session.error().message;
  for (LightDescription& light : session->lights) light.distance_sigma = Metres(0.0);
  const auto fitted = FitSession(*session, FitSettings{.effects = "none"});
  ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
  const ResidualRow& row = fitted->lights.lights.front().residuals.front();
  EXPECT_NEAR(row.measured_lx, 100.0, 1e-9);
  EXPECT_NEAR(row.sigma_relative, 0.01 * std::sqrt(2.0 * 2.0 + 1.0), 1e-9);
}

TEST(LitReadings, UnknownNamesAndMixedKeysAreRefused) {
  const auto refused = [](const std::string& reading) {
    const auto session =
        ParseSessionToml(kThreeLamps + ("[[reading]]\n" + reading), "session.toml");
    return session ? std::string() : session.error().code;
  };
  EXPECT_EQ(refused("lit = [\"kye\"]\nilluminance_lx = 1\n"), "unknown_light");
  EXPECT_EQ(refused("lit = []\ndistances_m = { kye = 1 }\nilluminance_lx = 1\n"), "unknown_light");
  EXPECT_EQ(refused("lit = [\"key\"]\nlight = \"key\"\nilluminance_lx = 1\n"), "bad_session");
  EXPECT_EQ(refused("lit = [\"key\"]\ndistance_m = 1\nilluminance_lx = 1\n"), "bad_session");
  EXPECT_EQ(refused("light = \"key\"\ndistances_m = { key = 1 }\nilluminance_lx = 1\n"),
            "bad_session");
  EXPECT_EQ(refused("lit = [\"key\"]\ndistances_m = { key = 0 }\nilluminance_lx = 1\n"),
            "bad_session");
  EXPECT_EQ(refused("lit = [\"key\"]\ncct_K = 3000\n"), "bad_session");
}

}  // namespace
}  // namespace lightcal
