// SPDX-License-Identifier: Apache-2.0
// The dialogue, on a line in memory: no waiting, every fault.
#include <gmock/gmock.h>

#include "fake_konica.h"
#include "fake_transport.h"
#include "lightcal_devices/meters/konica/meter.h"
#include "lightcal_devices/transport/recording.h"
#include "lightcal_devices/transport/replay.h"

namespace lightcal::devices::konica {
namespace {

using test::kCl200aBodies;
using test::KonicaAnswers;
using test::KonicaCommands;
using test::kPullThePlug;
using test::kT10aBodies;
using test::QuickSetup;
using test::SerialFake;
using testing::ElementsAre;
using testing::HasSubstr;

using Bodies = std::map<std::string, std::string>;

// The bodies with one replaced.
Bodies With(Bodies bodies, const std::string& command, const std::string& body) {
  bodies[command] = body;
  return bodies;
}

struct Outcome {
  Result<MeterReading> reading;
  std::vector<std::string> commands;
};

Outcome Cl200a(test::SerialAnswers answers, const Cancellation& cancellation = Cancellation()) {
  SerialFake line("\r\n", std::move(answers));
  auto reading = Cl200aMeter(line, QuickSetup()).Measure(cancellation);
  return {std::move(reading), KonicaCommands(line.commands())};
}

Outcome T10a(test::SerialAnswers answers) {
  SerialFake line("\r\n", std::move(answers));
  auto reading = T10aMeter(line, QuickSetup()).Measure(Cancellation());
  return {std::move(reading), KonicaCommands(line.commands())};
}

// Answers as `answers` do, but the command `at` as `instead` says, the first `times` times.
test::SerialAnswers Faulty(test::SerialAnswers answers, std::string at, std::string instead,
                           int times = 1000) {
  return [=](const std::string& command) mutable {
    if (command.substr(1, at.size()) == at && times-- > 0) return instead;
    return answers(command);
  };
}

TEST(Cl200aMeter, HoldsMeasuresAndRunsAgain) {
  const Outcome outcome = Cl200a(KonicaAnswers(kCl200aBodies));
  ASSERT_TRUE(outcome.reading) << outcome.reading.error().message;
  const Reading& reading = outcome.reading->reading;
  EXPECT_EQ(reading.illuminance->value(), 27.3);
  EXPECT_EQ(reading.xy->x, 0.4545);
  EXPECT_EQ(reading.xy->y, 0.4499);
  EXPECT_EQ(reading.cct->value(), 3067.0);
  EXPECT_EQ(*reading.duv, 0.0148);
  EXPECT_EQ(reading.quality, MeterQuality::kColorimeter);
  EXPECT_EQ(reading.color_source, ColorSource::kColorimeter);
  EXPECT_EQ(reading.device, "konica_cl200a:CL-200A");
  // 2 % and a digit of 0.1 lx, uniform.
  EXPECT_NEAR(*reading.sigma_relative, std::hypot(0.02, 0.1 / std::sqrt(12.0) / 27.3), 1e-12);
  EXPECT_THAT(outcome.commands, ElementsAre("00541   ", "99551  0", "004010  ", "994021  ",
                                            "00021200", "00081200", "99550  0"));
}

TEST(Cl200aMeter, OverRangeIsALimitWithoutColour) {
  const auto over =
      Cl200a(KonicaAnswers(With(kCl200aBodies, "00021200", "00021510                  ")));
  ASSERT_TRUE(over.reading) << over.reading.error().message;
  EXPECT_TRUE(over.reading->reading.over_range);
  EXPECT_EQ(over.reading->reading.illuminance->value(), 99990.0);
  EXPECT_FALSE(over.reading->reading.xy);
  EXPECT_EQ(over.commands.back(), "99550  0");
}

TEST(Cl200aMeter, TooDarkForColourKeepsTheIlluminance) {
  const auto outcome =
      Cl200a(KonicaAnswers(With(kCl200aBodies, "00021200", "00021610+  122+45450+44990")));
  ASSERT_TRUE(outcome.reading);
  EXPECT_EQ(outcome.reading->reading.illuminance->value(), 0.12);
  EXPECT_FALSE(outcome.reading->reading.xy);
  EXPECT_FALSE(outcome.reading->reading.cct);
  EXPECT_EQ(outcome.reading->warnings.at(0).code, "self_check");  // 08 told another illuminance
  EXPECT_EQ(outcome.reading->warnings.at(1).code, "low_light_color");
}

TEST(Cl200aMeter, ALightWithoutColourTemperatureKeepsItsChromaticity) {
  const auto outcome =
      Cl200a(KonicaAnswers(With(kCl200aBodies, "00081200", "00081710+ 2733            ")));
  ASSERT_TRUE(outcome.reading);
  EXPECT_TRUE(outcome.reading->reading.xy);
  EXPECT_FALSE(outcome.reading->reading.cct);
  EXPECT_EQ(outcome.reading->warnings.at(0).code, "cct_out_of_range");
}

TEST(Cl200aMeter, ARefusedModeIsHeldAndAskedForOnceMore) {
  const auto once =
      Cl200a(Faulty(KonicaAnswers(kCl200aBodies), "0040", test::KonicaFrame("0040 4  "), 1));
  ASSERT_TRUE(once.reading) << once.reading.error().message;
  EXPECT_THAT(once.commands, ElementsAre("00541   ", "99551  0", "004010  ", "99551  0", "004010  ",
                                         "994021  ", "00021200", "00081200", "99550  0"));
  const auto always =
      Cl200a(Faulty(KonicaAnswers(kCl200aBodies), "0040", test::KonicaFrame("0040 4  ")));
  EXPECT_EQ(always.reading.error().code, "ext_refused");
  EXPECT_EQ(always.commands.back(), "99550  0");
}

// Every fault, after the meter was held: a typed error, and the meter runs again.
struct FaultCase {
  const char* name;
  std::string at;
  std::string instead;
  const char* code;
};
void PrintTo(const FaultCase& fault_case, std::ostream* os) { *os << fault_case.name; }
class KonicaFault : public testing::TestWithParam<FaultCase> {};
TEST_P(KonicaFault, IsATypedErrorAndTheMeterRunsAgain) {
  const auto& [name, at, instead, code] = GetParam();
  const Outcome outcome = Cl200a(Faulty(KonicaAnswers(kCl200aBodies), at, instead));
  ASSERT_FALSE(outcome.reading);
  EXPECT_EQ(outcome.reading.error().code, code) << outcome.reading.error().message;
  EXPECT_EQ(outcome.commands.back(), instead == kPullThePlug ? at + "1200" : "99550  0");
}
const std::string kDamaged =
    "\x02"
    "00021 10+ 2733+45450+44990\x03"
    "FF\r\n";
INSTANTIATE_TEST_SUITE_P(
    KonicaMeter, KonicaFault,
    testing::Values(FaultCase{"SilentMode", "0040", "", "timeout"},
                    FaultCase{"SilentReading", "0002", "", "timeout"},
                    FaultCase{"DamagedReading", "0002", kDamaged, "bad_reply"},
                    FaultCase{"ShortReading", "0002",
                              "\x02"
                              "00021",
                              "bad_reply"},
                    FaultCase{"EndlessReading", "0008", std::string(300, 'x'), "bad_reply"},
                    FaultCase{"HeadOff", "0002", test::KonicaFrame("00021110                  "),
                              "head_power_off"},
                    FaultCase{"MemoryError", "0002",
                              test::KonicaFrame("00021210                  "), "memory_error"},
                    FaultCase{"BatteryLow", "0008", test::KonicaFrame("00081 11+ 2733+30674+01480"),
                              "battery_low"},
                    FaultCase{"Unplugged", "0002", kPullThePlug, "unplugged"}),
    [](const auto& fault_case) { return std::string(fault_case.param.name); });

TEST(Cl200aMeter, ADamagedReplyIsAskedForOnceMore) {
  const auto outcome = Cl200a(Faulty(KonicaAnswers(kCl200aBodies), "0002", kDamaged, 1));
  ASSERT_TRUE(outcome.reading) << outcome.reading.error().message;
  EXPECT_EQ(std::ranges::count(outcome.commands, "00021200"), 2);
}

TEST(Cl200aMeter, CtrlCInTheMiddleSetsTheMeterRunning) {
  for (const std::string at : {"99551", "0040", "9940"}) {
    Cancellation cancellation;
    auto answers = KonicaAnswers(kCl200aBodies);
    const auto outcome = Cl200a(
        [&](const std::string& command) {
          if (command.substr(1, at.size()) == at) cancellation.Request();
          return answers(command);
        },
        cancellation);
    ASSERT_FALSE(outcome.reading);
    EXPECT_EQ(outcome.reading.error().code, "interrupted");
    EXPECT_EQ(outcome.commands.back(), "99550  0") << at;
  }
}

TEST(Cl200aMeter, CtrlCDuringASilenceIsCtrlC) {
  Cancellation cancellation;
  const auto outcome = Cl200a(
      [&](const std::string& command) {
        if (command.substr(1, 4) != "0002") return KonicaAnswers(kCl200aBodies)(command);
        cancellation.Request();
        return std::string();
      },
      cancellation);
  EXPECT_EQ(outcome.reading.error().code, "interrupted");
  EXPECT_EQ(outcome.commands.back(), "99550  0");
}

TEST(T10aMeter, SetsAutomaticRangeOnceAndThenReads) {
  SerialFake line("\r\n", KonicaAnswers(kT10aBodies));
  T10aMeter meter(line, QuickSetup());
  for (int i = 0; i < 2; ++i) {
    const auto reading = meter.Measure(Cancellation());
    ASSERT_TRUE(reading) << reading.error().message;
    EXPECT_EQ(reading->reading.illuminance->value(), 1234.0);
    EXPECT_EQ(reading->reading.quality, MeterQuality::kPhotometer);
    EXPECT_FALSE(reading->reading.cct);
  }
  EXPECT_THAT(KonicaCommands(line.commands()),
              ElementsAre("00541   ", "00100200", "00100200", "00100200"));
}

TEST(T10aMeter, OverRangeIsAtLeastTheTopOfTheHighestRange) {
  const auto over =
      T10a(KonicaAnswers(With(kT10aBodies, "00100200", "00101500                  ")));
  ASSERT_TRUE(over.reading) << over.reading.error().message;
  EXPECT_TRUE(over.reading->reading.over_range);
  EXPECT_EQ(over.reading->reading.illuminance->value(), 299900.0);
}

TEST(T10aMeter, AHeadIsAskedByItsNumberAndAWrongOneIsSaid) {
  SerialFake line("\r\n", KonicaAnswers({{"00541   ", "0054    "},
                                         {"03100200", "03101 00+12344            "}}));
  auto setup = QuickSetup();
  setup.options["head"] = "3";
  const auto reading = T10aMeter(line, setup).Measure(Cancellation());
  ASSERT_TRUE(reading) << reading.error().message;
  setup.options["head"] = "30";
  const auto wrong = T10aMeter(line, setup).Identify();
  EXPECT_EQ(wrong.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(wrong.error().message, HasSubstr("0 to 29"));
}

// What was recorded plays again, a fault included.
TEST(KonicaMeter, ARecordedDialogueReplaysToTheSameOutcome) {
  for (const std::string& at : {std::string("none"), std::string("0002"), std::string("0040")}) {
    SerialFake line("\r\n", Faulty(KonicaAnswers(kCl200aBodies), at, "\x02", 1));
    Tape tape;
    RecordingTransport recording(line, tape);
    const auto first = Cl200aMeter(recording, QuickSetup()).Measure(Cancellation());
    ReplayTransport replay(tape);
    const auto again = Cl200aMeter(replay, QuickSetup()).Measure(Cancellation());
    EXPECT_EQ(replay.Unconsumed(), 0U);
    ASSERT_EQ(first.has_value(), again.has_value());
    EXPECT_EQ(first.has_value(), at != "0040");
  }
}

}  // namespace
}  // namespace lightcal::devices::konica
