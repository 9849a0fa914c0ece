// SPDX-License-Identifier: Apache-2.0
// The dialogue, on a line in memory: no waiting, every fault.
#include <gmock/gmock.h>

#include "fake_transport.h"
#include "lightcal_devices/meters/sekonic/meter.h"
#include "lightcal_devices/transport/recording.h"
#include "lightcal_devices/transport/replay.h"
#include "lightcal_devices/transport/tape_codec.h"

namespace lightcal::devices::sekonic {
namespace {

using test::Answering407lx;
using test::FakeTransport;
using test::Fault;
using test::QuickSetup;
using testing::ElementsAre;

struct Outcome {
  Result<MeterReading> reading;
  std::vector<std::string> commands;
  bool remote = false;
};

Outcome Measured(const test::SekonicSetting& setting) {
  FakeTransport line(setting);
  SekonicMeter meter(line, QuickSetup());
  auto reading = meter.Measure(Cancellation());
  return {std::move(reading), line.meter().commands(), line.meter().remote()};
}

test::SekonicSetting With(const std::string& command, Fault fault, int times = 1000000) {
  auto setting = Answering407lx();
  setting.fault_command = command;
  setting.fault = fault;
  setting.fault_times = times;
  return setting;
}

TEST(SekonicMeter, MeasuresAndGivesTheMeterBack) {
  const Outcome outcome = Measured(Answering407lx());
  ASSERT_TRUE(outcome.reading) << outcome.reading.error().message;
  EXPECT_NEAR(outcome.reading->reading.illuminance->value(), 406.960, 5e-4);
  EXPECT_EQ(outcome.reading->reading.device, "sekonic:C-800");
  EXPECT_THAT(outcome.commands,
              ElementsAre("MN", "ST", "RT1", "RM0", "ST", "ST", "ST", "NR", "RT0"));
  EXPECT_FALSE(outcome.remote);
}

TEST(SekonicMeter, TheSerialNamesTheDeviceWhenThereIsOne) {
  FakeTransport line(Answering407lx());
  EXPECT_EQ(SekonicMeter(line, QuickSetup("J1234")).Measure(Cancellation())->reading.device,
            "sekonic:J1234");
}

TEST(SekonicMeter, OnlyAC7000IsSetUpAndItsShutterOnlyWithLateFirmware) {
  auto setting = Answering407lx();
  setting.model = "C-7000";
  setting.busy_polls_after = 0;
  EXPECT_THAT(Measured(setting).commands,
              ElementsAre("MN", "ST", "RT1", "FV", "AGw,0", "MMw,0", "AMw,0", "SSw,0,08", "RM0",
                          "ST", "NR", "RT0"));
  setting.firmware = "20,C36E,25,7881";
  EXPECT_THAT(Measured(setting).commands, testing::Not(testing::Contains("SSw,0,08")));
}

TEST(SekonicMeter, WaitsWhileTheMeterStarts) {
  auto setting = Answering407lx();
  setting.busy_polls_before = 3;
  EXPECT_TRUE(Measured(setting).reading);
}

TEST(SekonicMeter, AMeterBusyTooLongIsReportedAndNotTakenOver) {
  auto setting = Answering407lx();
  setting.busy_polls_before = 1000;
  const Outcome outcome = Measured(setting);
  EXPECT_EQ(outcome.reading.error().code, "busy");
  EXPECT_THAT(outcome.reading.error().message, testing::HasSubstr("initialising"));
  EXPECT_THAT(outcome.commands, testing::Not(testing::Contains("RT1")));
}

TEST(SekonicMeter, AMeasurementWithoutEndIsBusyAndTheMeterIsGivenBack) {
  auto setting = Answering407lx();
  setting.busy_polls_after = 1000;
  const Outcome outcome = Measured(setting);
  EXPECT_EQ(outcome.reading.error().code, "busy");
  EXPECT_EQ(outcome.commands.back(), "RT0");
  EXPECT_FALSE(outcome.remote);
}

TEST(SekonicMeter, ADarkCalibrationIsGivenFourTimesThePatienceAndNoted) {
  auto setting = Answering407lx();
  setting.busy_is_dark = true;
  setting.busy_polls_before = 3 * QuickSetup().timing.ready_polls;
  const Outcome outcome = Measured(setting);
  ASSERT_TRUE(outcome.reading) << outcome.reading.error().message;
  ASSERT_EQ(outcome.reading->warnings.size(), 1U);
  EXPECT_EQ(outcome.reading->warnings[0].code, "dark_calibration");
  setting.busy_polls_before = 1000;
  const Outcome endless = Measured(setting);
  EXPECT_EQ(endless.reading.error().code, "busy");
  EXPECT_THAT(endless.reading.error().message, testing::HasSubstr("calibrating its dark signal"));
}

test::SekonicSetting C7000WithMemory() {
  auto setting = Answering407lx();
  setting.model = "C-7000";
  setting.memory = {test::RecordedReply(test::kReply14lx), test::RecordedReply(test::kReply407lx)};
  return setting;
}

TEST(SekonicMemory, AStoredReadingIsReadWithoutTakingTheMeterOver) {
  FakeTransport line(C7000WithMemory());
  const auto reading = SekonicMeter(line, QuickSetup()).ReadMemory(1, Cancellation());
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_NEAR(reading->reading.illuminance->value(), 406.960, 5e-4);
  ASSERT_EQ(reading->warnings.size(), 1U);
  EXPECT_EQ(reading->warnings[0].code, "experimental");
  EXPECT_THAT(line.meter().commands(), ElementsAre("MN", "MI", "MR0001"));
}

TEST(SekonicMemory, WhatIsNotThereIsRefused) {
  FakeTransport line(C7000WithMemory());
  SekonicMeter meter(line, QuickSetup());
  EXPECT_EQ(meter.ReadMemory(2, Cancellation()).error().code, "no_such_reading");
  EXPECT_EQ(meter.ReadMemory(-1, Cancellation()).error().code, "no_such_reading");
  FakeTransport other(Answering407lx());
  EXPECT_EQ(SekonicMeter(other, QuickSetup()).ReadMemory(0, Cancellation()).error().code,
            "no_memory");
}

TEST(SekonicMemory, FaultsAreTyped) {
  auto setting = C7000WithMemory();
  setting.fault_command = "MR0000";
  for (const auto& [fault, code] : std::map<Fault, std::string>{{Fault::kNak, "nak"},
                                                                {Fault::kShort, "bad_reply"},
                                                                {Fault::kSilent, "timeout"},
                                                                {Fault::kUnplug, "unplugged"}}) {
    setting.fault = fault;
    FakeTransport line(setting);
    EXPECT_EQ(SekonicMeter(line, QuickSetup()).ReadMemory(0, Cancellation()).error().code, code);
  }
}

class WrongRing : public testing::TestWithParam<unsigned> {};
TEST_P(WrongRing, IsSaidBeforeAnythingIsMeasured) {
  auto setting = Answering407lx();
  setting.ring = GetParam();
  const Outcome outcome = Measured(setting);
  EXPECT_EQ(outcome.reading.error().code, "wrong_ring");
  EXPECT_THAT(outcome.reading.error().message, testing::HasSubstr("turn it to LOW"));
  EXPECT_THAT(outcome.commands, ElementsAre("MN", "ST"));
}
INSTANTIATE_TEST_SUITE_P(SekonicMeter, WrongRing, testing::Values(0U, 1U, 3U));

TEST(SekonicMeter, APressedMeasuringButtonIsSaid) {
  auto setting = Answering407lx();
  setting.button = 2;
  EXPECT_EQ(Measured(setting).reading.error().code, "button_held");
}

// Every fault, at every step after the meter was taken over: a typed error, and remote control off.
struct FaultCase {
  Fault fault;
  const char* code;
};
void PrintTo(const FaultCase& fault_case, std::ostream* os) { *os << fault_case.code; }
class EveryStep : public testing::TestWithParam<std::tuple<FaultCase, const char*>> {};
TEST_P(EveryStep, FailsByNameAndGivesTheMeterBack) {
  const auto& [fault_case, command] = GetParam();
  const Outcome outcome = Measured(With(command, fault_case.fault));
  ASSERT_FALSE(outcome.reading);
  EXPECT_EQ(outcome.reading.error().code, fault_case.code);
  EXPECT_EQ(outcome.reading.error().kind, ErrorKind::kFailed);
  EXPECT_THAT(outcome.reading.error().message, testing::HasSubstr(std::string(command) + ": "));
  EXPECT_EQ(outcome.commands.back(), "RT0");
  EXPECT_FALSE(outcome.remote);
}
INSTANTIATE_TEST_SUITE_P(SekonicMeter, EveryStep,
                         testing::Combine(testing::Values(FaultCase{Fault::kNak, "nak"},
                                                          FaultCase{Fault::kSilent, "timeout"},
                                                          FaultCase{Fault::kStall, "stalled"},
                                                          FaultCase{Fault::kWrongEcho,
                                                                    "bad_reply"}),
                                          testing::Values("RT1", "RM0", "NR")));

TEST(SekonicMeter, AnUnpluggedMeterIsNotSpokenToAgain) {
  const Outcome outcome = Measured(With("NR", Fault::kUnplug));
  EXPECT_EQ(outcome.reading.error().code, "unplugged");
  EXPECT_EQ(outcome.commands.back(), "NR");
}

TEST(SekonicMeter, OneShortReplyIsAskedForOnceMore) {
  const Outcome outcome = Measured(With("NR", Fault::kShort, 1));
  ASSERT_TRUE(outcome.reading) << outcome.reading.error().message;
  EXPECT_THAT(outcome.commands, testing::IsSupersetOf({"NR", "NR", "RT0"}));
}

TEST(SekonicMeter, TwoShortRepliesAreAnError) {
  const Outcome outcome = Measured(With("NR", Fault::kShort));
  EXPECT_EQ(outcome.reading.error().code, "bad_reply");
  EXPECT_THAT(outcome.reading.error().message, testing::HasSubstr("2370 bytes, not 2380"));
  EXPECT_EQ(std::ranges::count(outcome.commands, "NR"), 2);
  EXPECT_EQ(outcome.commands.back(), "RT0");
}

TEST(SekonicMeter, OrdersAreNeverRepeated) {
  const Outcome outcome = Measured(With("RM0", Fault::kWrongEcho, 1));
  EXPECT_FALSE(outcome.reading);
  EXPECT_EQ(std::ranges::count(outcome.commands, "RM0"), 1);
}

TEST(SekonicMeter, AReadingSurvivesAMeterThatWillNotBeGivenBack) {
  const Outcome outcome = Measured(With("RT0", Fault::kSilent));
  ASSERT_TRUE(outcome.reading);
  ASSERT_EQ(outcome.reading->warnings.size(), 1U);
  EXPECT_EQ(outcome.reading->warnings[0].code, "not_restored");
}

// Cancels when the meter has taken a given command, as Ctrl-C would in the middle.
class CancellingTransport final : public Transport {
 public:
  CancellingTransport(Transport& inner, Cancellation& cancellation, std::string at)
      : inner_(inner), cancellation_(cancellation), at_(std::move(at)) {}
  Result<void> Write(std::span<const std::byte> bytes, std::chrono::milliseconds t) override {
    if (std::ranges::equal(bytes, AsBytes(at_))) cancellation_.Request();
    return inner_.Write(bytes, t);
  }
  Result<Bytes> Read(std::size_t max, std::chrono::milliseconds t) override {
    return inner_.Read(max, t);
  }
  [[nodiscard]] std::string Name() const override { return inner_.Name(); }

 private:
  Transport& inner_;
  Cancellation& cancellation_;
  std::string at_;
};

TEST(SekonicMeter, ACancelledMeasurementGivesTheMeterBack) {
  auto setting = Answering407lx();
  setting.busy_polls_after = 1000;
  FakeTransport line(setting);
  Cancellation cancellation;
  CancellingTransport cancelling(line, cancellation, "RM0");
  SekonicMeter meter(cancelling, QuickSetup());
  EXPECT_EQ(meter.Measure(cancellation).error().code, "interrupted");
  EXPECT_THAT(line.meter().commands(), ElementsAre("MN", "ST", "RT1", "RM0", "RT0"));
  EXPECT_FALSE(line.meter().remote());
}

TEST(SekonicMeter, AnUnknownModelIsMeasuredWithAWarning) {
  auto setting = Answering407lx();
  setting.model = "C-9000";
  FakeTransport line(setting);
  const auto identity = SekonicMeter(line, QuickSetup()).Identify();
  ASSERT_TRUE(identity);
  ASSERT_EQ(identity->warnings.size(), 1U);
  EXPECT_EQ(identity->warnings[0].code, "untested_model");
}

// What was recorded plays again, whatever went wrong in it.
class RecordedDialogue : public testing::TestWithParam<Fault> {};
TEST_P(RecordedDialogue, ReplaysToTheSameOutcome) {
  FakeTransport line(With("NR", GetParam()));
  Tape tape;
  tape.driver = "sekonic";
  RecordingTransport recording(line, tape);
  const auto first = SekonicMeter(recording, QuickSetup()).Measure(Cancellation());

  const auto read_back = TapeFromText(TapeToText(tape), "tape");
  ASSERT_TRUE(read_back) << read_back.error().message;
  ReplayTransport replay(*read_back);
  const auto again = SekonicMeter(replay, QuickSetup()).Measure(Cancellation());
  EXPECT_EQ(replay.Unconsumed(), 0U);
  ASSERT_EQ(first.has_value(), again.has_value());
  if (first) {
    EXPECT_EQ(first->reading.illuminance->value(), again->reading.illuminance->value());
  } else {
    EXPECT_EQ(first.error().code, again.error().code);
  }
}
INSTANTIATE_TEST_SUITE_P(SekonicMeter, RecordedDialogue,
                         testing::Values(Fault::kNone, Fault::kNak, Fault::kSilent, Fault::kShort,
                                         Fault::kStall, Fault::kUnplug));

}  // namespace
}  // namespace lightcal::devices::sekonic
