// SPDX-License-Identifier: Apache-2.0
// The dialogue, on a line in memory: no waiting, every fault.
#include <gmock/gmock.h>

#include "fake_gossen.h"
#include "fake_transport.h"
#include "lightcal_devices/meters/gossen/meter.h"
#include "lightcal_devices/transport/recording.h"
#include "lightcal_devices/transport/replay.h"

namespace lightcal::devices::gossen {
namespace {

using test::GossenAnswers;
using test::GossenWith;
using test::kGossenLines;
using test::kPullThePlug;
using test::QuickSetup;
using test::SerialFake;
using testing::ElementsAre;

Result<MeterReading> Measured(const test::GossenLines& lines,
                              const MeterSetup& setup = QuickSetup()) {
  SerialFake line("\n", GossenAnswers(lines));
  return GossenMeter(line, setup).Measure(Cancellation());
}

TEST(GossenMeter, NamesItselfAndMeasures) {
  SerialFake line("\n", GossenAnswers(kGossenLines));
  GossenMeter meter(line, QuickSetup());
  const auto identity = meter.Identify();
  ASSERT_TRUE(identity) << identity.error().message;
  EXPECT_EQ(identity->firmware, "V 1.00");
  for (int i = 0; i < 2; ++i) {
    const auto reading = meter.Measure(Cancellation());
    ASSERT_TRUE(reading) << reading.error().message;
    EXPECT_EQ(reading->reading.illuminance->value(), 123.4);
    EXPECT_EQ(reading->reading.device, "gossen:20387");
    EXPECT_EQ(reading->reading.quality, MeterQuality::kPhotometer);
    EXPECT_FALSE(reading->reading.cct);
  }
  EXPECT_THAT(line.commands(), ElementsAre("ECH ON", "*IDN?", "RAN:AUTO ON", "?", "?"));
}

TEST(GossenMeter, TheClassOfTheMeterIsItsSigma) {
  auto setup = QuickSetup();
  const double digit = 0.1 / std::sqrt(12.0) / 123.4;
  EXPECT_NEAR(*Measured(kGossenLines)->reading.sigma_relative, std::hypot(0.10, digit), 1e-12);
  setup.options["class"] = "B";
  EXPECT_NEAR(*Measured(kGossenLines, setup)->reading.sigma_relative, std::hypot(0.05, digit),
              1e-12);
  setup.options["class"] = "A";
  EXPECT_EQ(Measured(kGossenLines, setup).error().kind, ErrorKind::kUsage);
}

TEST(GossenMeter, OverRangeIsALimit) {
  for (const char* line : {"ERROR = 19", "ERROR = 203"}) {
    const auto reading = Measured(GossenWith("?", line));
    ASSERT_TRUE(reading) << reading.error().message;
    EXPECT_TRUE(reading->reading.over_range);
    EXPECT_EQ(reading->reading.illuminance->value(), 199900.0);
  }
}

struct FaultCase {
  const char* name;
  const char* command;
  std::string line;
  const char* code;
};
void PrintTo(const FaultCase& fault_case, std::ostream* os) { *os << fault_case.name; }
class GossenFault : public testing::TestWithParam<FaultCase> {};
TEST_P(GossenFault, IsATypedErrorThatNamesTheCommand) {
  const auto& [name, command, line, code] = GetParam();
  const auto reading = Measured(GossenWith(command, line));
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().code, code) << reading.error().message;
  EXPECT_EQ(reading.error().kind, ErrorKind::kFailed);
}
INSTANTIATE_TEST_SUITE_P(
    GossenMeter, GossenFault,
    testing::Values(FaultCase{"SilentAtFirst", "ECH ON", "", "timeout"},
                    FaultCase{"SilentMeasurement", "?", "", "timeout"},
                    FaultCase{"AnotherInstrument", "*IDN?", "KEITHLEY,2000,1,2,3", "bad_reply"},
                    FaultCase{"Garbage", "?", "1234E-", "bad_reply"},
                    FaultCase{"EndlessLine", "?", std::string(200, '1'), "bad_reply"},
                    FaultCase{"Luminance", "?", "12E00 CD_M2", "luminance_head"},
                    FaultCase{"ParityErrors", "?", "ERROR = 3", "serial_error"},
                    FaultCase{"WrongHead", "?", "ERROR = 202", "wrong_head"},
                    FaultCase{"RefusedRange", "RAN:AUTO ON", "ERROR = 104", "refused_command"},
                    FaultCase{"Unplugged", "?", kPullThePlug, "unplugged"}),
    [](const auto& fault_case) { return std::string(fault_case.param.name); });

// Answers "?" with the first line once, then with the second.
test::SerialAnswers OnceThen(std::string first) {
  return [=, left = 1, answers = GossenAnswers(kGossenLines)](const std::string& command) mutable {
    return command == "?" && left-- > 0 ? first + "\n" : answers(command);
  };
}

TEST(GossenMeter, AnOverrunAndADamagedLineAreAskedForOnceMore) {
  for (const char* first : {"ERROR = 1", "12"}) {
    SerialFake line("\n", OnceThen(first));
    const auto reading = GossenMeter(line, QuickSetup()).Measure(Cancellation());
    ASSERT_TRUE(reading) << reading.error().message;
    EXPECT_EQ(std::ranges::count(line.commands(), "?"), 2);
  }
}

TEST(GossenMeter, OverRangeIsNotAskedAgain) {
  SerialFake line("\n", OnceThen("ERROR = 19"));
  EXPECT_TRUE(GossenMeter(line, QuickSetup()).Measure(Cancellation())->reading.over_range);
  EXPECT_EQ(std::ranges::count(line.commands(), "?"), 1);
}

TEST(GossenMeter, CtrlCStopsBeforeAMeasurementAndDuringASilentOne) {
  for (const char* at : {"RAN:AUTO ON", "?"}) {
    Cancellation cancellation;
    SerialFake line("\n", [&](const std::string& command) {
      if (command == at) cancellation.Request();
      return GossenAnswers(GossenWith("?", ""))(command);
    });
    EXPECT_EQ(GossenMeter(line, QuickSetup()).Measure(cancellation).error().code, "interrupted");
  }
}

TEST(GossenMeter, ARecordedDialogueReplaysToTheSameOutcome) {
  for (const char* first : {"1234E-01 LX", "ERROR = 1", "ERROR = 19", ""}) {
    SerialFake line("\n", OnceThen(first));
    Tape tape;
    RecordingTransport recording(line, tape);
    const auto reading = GossenMeter(recording, QuickSetup()).Measure(Cancellation());
    ReplayTransport replay(tape);
    const auto again = GossenMeter(replay, QuickSetup()).Measure(Cancellation());
    EXPECT_EQ(replay.Unconsumed(), 0U);
    ASSERT_TRUE(reading && again);
    EXPECT_EQ(reading->reading.illuminance->value(), again->reading.illuminance->value());
  }
}

}  // namespace
}  // namespace lightcal::devices::gossen
