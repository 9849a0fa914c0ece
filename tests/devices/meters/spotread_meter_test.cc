// SPDX-License-Identifier: Apache-2.0
// The dialogue with a program that prints what spotread prints, hangs, asks, crashes and babbles.
#include <gmock/gmock.h>

#include <csignal>
#include <thread>

#include "fake_spotread.h"
#include "fake_transport.h"
#include "lightcal_devices/meters/find_meters.h"
#include "lightcal_devices/meters/spotread/meter.h"
#include "lightcal_devices/transport/process.h"
#include "lightcal_devices/transport/recording.h"
#include "lightcal_devices/transport/replay.h"
#include "spotread_texts.h"
#include "warning_codes.h"

namespace lightcal::devices::spotread {
namespace {

using std::chrono::milliseconds;
using test::Codes;
using test::FakeSpotread;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace does = test::spotread_does;

MeterSetup Quick(const std::map<std::string, std::string>& options = {}) {
  MeterSetup setup = test::QuickSetup();
  setup.options = options;
  return setup;
}

std::unique_ptr<Transport> Line(const FakeSpotread& program) {
  return OpenProcess({.program = program.program(),
                      .environment = {"ARGYLL_NOT_INTERACTIVE=1"},
                      .longest_run = milliseconds(60000)});
}

Result<MeterReading> Measured(const FakeSpotread& program,
                              const std::map<std::string, std::string>& options = {}) {
  const auto line = Line(program);
  return SpotreadMeter(*line, Quick(options)).Measure(Cancellation());
}

TEST(SpotreadMeter, ASpectrometerIsReadInOneRun) {
  const FakeSpotread program({does::Print(test::kSpotreadSpectral)});
  const auto reading = Measured(program);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_EQ(reading->reading.illuminance->value(), 729.831);
  EXPECT_EQ(reading->reading.device, "spotread:1234567");
  EXPECT_EQ(reading->spectrum->values.size(), 36U);
  EXPECT_THAT(program.Runs(), ElementsAre("-v -a -x -T -s -O"));
}

TEST(SpotreadMeter, AColorimeterIsAskedAgainWithoutASpectrumAndThenNeverForOne) {
  const FakeSpotread program(
      {does::Print(test::kSpotreadNoSpectrum, 255), does::Print(test::kSpotreadColorimeter)});
  const auto line = Line(program);
  SpotreadMeter meter(*line, Quick());
  ASSERT_TRUE(meter.Measure(Cancellation()));
  const auto second = meter.Measure(Cancellation());
  ASSERT_TRUE(second);
  EXPECT_EQ(second->reading.illuminance->value(), 192.512345);
  EXPECT_EQ(second->reading.quality, MeterQuality::kColorimeter);
  EXPECT_THAT(program.Runs(), ElementsAre("-v -a -x -T -s -O", "-v -a -x -T -O", "-v -a -x -T -O"));
}

TEST(SpotreadMeter, TheOptionsBecomeArgumentsBeforeO) {
  const FakeSpotread program({does::Print(test::kSpotreadSpectral)});
  ASSERT_TRUE(Measured(program, {{"port", "2"}, {"ccss", "led.ccss"}, {"hires", "yes"}}));
  EXPECT_THAT(program.Runs(), ElementsAre("-v -a -x -T -s -X led.ccss -H -c 2 -O"));
}

TEST(SpotreadMeter, AnotherProgramMayBeNamed) {
  const FakeSpotread program({does::Print(test::kSpotreadSpectral)});
  const auto line = OpenProcess(
      {.program = "no-such-spotread", .environment = {}, .longest_run = milliseconds(0)});
  SpotreadMeter named(*line, Quick({{"spotread", program.program()}}));
  EXPECT_TRUE(named.Measure(Cancellation()));
}

TEST(SpotreadMeter, AnOptionThatIsNoSuchValueIsAWrongCommandLine) {
  const FakeSpotread program({does::Print(test::kSpotreadSpectral)});
  const auto line = Line(program);
  for (const auto& [name, value] :
       std::map<std::string, std::string>{{"port", "-1"}, {"hires", "perhaps"}, {"ccss", "a\nb"}}) {
    SpotreadMeter meter(*line, Quick({{name, value}}));
    EXPECT_EQ(meter.Identify().error().kind, ErrorKind::kUsage) << name;
  }
  EXPECT_THAT(program.Runs(), IsEmpty());
}

TEST(SpotreadMeter, IdentifyingStartsNothing) {
  const FakeSpotread program({does::Hang()});
  const auto line = Line(program);
  EXPECT_EQ(SpotreadMeter(*line, Quick()).Identify()->model, "ArgyllCMS");
  EXPECT_THAT(program.Runs(), IsEmpty());
}

TEST(SpotreadMeter, ACalibrationByItselfIsFollowedByTheReading) {
  const FakeSpotread program(
      {does::Print(test::kSpotreadCalibratedItself), does::Print(test::kSpotreadSpectral)});
  const auto reading = Measured(program);
  ASSERT_TRUE(reading) << reading.error().message;
  EXPECT_THAT(Codes(reading->warnings), ElementsAre("calibrated"));
  EXPECT_EQ(program.Runs().size(), 2U);
}

TEST(SpotreadMeter, ACalibrationWithoutEndIsAnErrorAfterTwoMoreRuns) {
  const FakeSpotread program({does::Print(test::kSpotreadCalibratedItself)});
  EXPECT_EQ(Measured(program).error().code, "calibrated");
  EXPECT_EQ(program.Runs().size(), 3U);
}

TEST(SpotreadMeter, ACalibrationThatNeedsThePersonQuotesItsOrders) {
  const FakeSpotread program({does::Print(test::kSpotreadPlacedToCalibrate)});
  const auto reading = Measured(program);
  EXPECT_EQ(reading.error().code, "calibrated");
  EXPECT_THAT(reading.error().message, HasSubstr("on its reflective white reference S/N 1234567"));
  EXPECT_EQ(program.Runs().size(), 1U);
}

TEST(SpotreadMeter, AResultReadOnTheCalibrationTileIsNotBelieved) {
  const FakeSpotread program(
      {does::Print(test::kSpotreadPlacedToCalibrate + test::kSpotreadSpectral)});
  EXPECT_EQ(Measured(program).error().code, "calibrated");
}

TEST(SpotreadMeter, TheRetryPromptIsAnsweredWithQ) {
  const FakeSpotread program({does::AskToRetry(test::kSpotreadMisread)});
  const auto reading = Measured(program);
  EXPECT_EQ(reading.error().code, "misread");
  EXPECT_THAT(program.Keys(), ElementsAre("key:q"));
}

TEST(SpotreadMeter, AProgramThatAsksWhateverItIsToldIsStopped) {
  const FakeSpotread program({does::Repeat(test::kSpotreadMisread)});
  EXPECT_EQ(Measured(program).error().code, "misread");
}

TEST(SpotreadMeter, ADialInTheWrongPositionIsSaidAndTheEndlessRunStopped) {
  const FakeSpotread program({does::Repeat(
      "\n\nSpot read failed due to the sensor being in the wrong position\n(Sensor)\n")});
  EXPECT_EQ(Measured(program).error().code, "wrong_position");
}

TEST(SpotreadMeter, AnInstrumentWithoutAmbientHeadIsSaid) {
  const FakeSpotread program({does::Print(test::kSpotreadNoAmbient, 255)});
  EXPECT_EQ(Measured(program).error().code, "no_ambient");
}

TEST(SpotreadMeter, NoInstrumentIsNoDevice) {
  const FakeSpotread program({does::Print("spotread: Error - No instrument at port 1", 1)});
  EXPECT_EQ(Measured(program).error().code, "no_device");
}

TEST(SpotreadMeter, DarknessAndSaturationAreNoNumbers) {
  const FakeSpotread dark({does::Print("spotread: Error - Got bad cct", 1)});
  EXPECT_EQ(Measured(dark).error().code, "too_dark");
  const FakeSpotread zero({does::Print(" Result is Y: 0.000000, L*: 0.0\n Ambient = 0.0 Lux")});
  EXPECT_EQ(Measured(zero).error().code, "too_dark");
  const FakeSpotread bright(
      {does::AskToRetry("Spot read failed due to misread (Sensor is saturated)\n"
                        "Hit Esc or Q to give up, any other key to retry:")});
  const auto reading = Measured(bright);
  EXPECT_EQ(reading.error().code, "over_range");
  EXPECT_EQ(reading.error().kind, ErrorKind::kRefused);
}

TEST(SpotreadMeter, ACrashGarbageAndSilenceAreTypedErrors) {
  EXPECT_EQ(Measured(FakeSpotread({does::Crash()})).error().code, "bad_reply");
  EXPECT_EQ(Measured(FakeSpotread({"head -c 4000 /dev/urandom"})).error().code, "bad_reply");
  EXPECT_EQ(Measured(FakeSpotread({"yes"})).error().code, "bad_reply");
  EXPECT_EQ(Measured(FakeSpotread({"exit 0"})).error().code, "bad_reply");
}

TEST(SpotreadMeter, AProgramThatHangsIsGivenUpAndGone) {
  const FakeSpotread program({does::Hang()});
  const auto line = Line(program);
  MeterSetup setup = Quick();
  setup.timing.reply = milliseconds(4);  // 240 ms of silence
  EXPECT_EQ(SpotreadMeter(*line, setup).Measure(Cancellation()).error().code, "timeout");
  const pid_t pid = std::stoi(test::ReadFile(program.dir().path() + "/pid"));
  EXPECT_EQ(::kill(pid, 0), -1);
}

TEST(SpotreadMeter, AMissingProgramTeachesHowToInstallIt) {
  const auto line = OpenProcess(
      {.program = "no-such-spotread", .environment = {}, .longest_run = milliseconds(0)});
  const auto reading = SpotreadMeter(*line, Quick()).Measure(Cancellation());
  EXPECT_EQ(reading.error().code, "no_device");
  EXPECT_THAT(reading.error().message, HasSubstr("install ArgyllCMS"));
}

TEST(SpotreadMeter, ACancelledReadingEndsTheProgram) {
  const FakeSpotread program({does::Hang()});
  const auto line = Line(program);
  Cancellation cancellation;
  std::thread canceller([&] {
    while (test::ReadFile(program.dir().path() + "/pid").empty()) std::this_thread::yield();
    cancellation.Request();
  });
  const auto reading = SpotreadMeter(*line, Quick()).Measure(cancellation);
  canceller.join();
  EXPECT_EQ(reading.error().code, "interrupted");
  const pid_t pid = std::stoi(test::ReadFile(program.dir().path() + "/pid"));
  EXPECT_EQ(::kill(pid, 0), -1);
}

// What was recorded plays again, whatever went wrong in it.
class SpotreadDialogue : public testing::TestWithParam<std::vector<std::string>> {};
TEST_P(SpotreadDialogue, ReplaysToTheSameOutcome) {
  const FakeSpotread program(GetParam());
  const auto line = Line(program);
  Tape tape;
  tape.driver = "spotread";
  RecordingTransport recording(*line, tape);
  const auto first = SpotreadMeter(recording, Quick()).Measure(Cancellation());
  ReplayTransport replay(tape);
  const auto again = SpotreadMeter(replay, Quick()).Measure(Cancellation());
  EXPECT_EQ(replay.Unconsumed(), 0U);
  ASSERT_EQ(first.has_value(), again.has_value());
  if (first) {
    EXPECT_EQ(first->reading.illuminance->value(), again->reading.illuminance->value());
  } else {
    EXPECT_EQ(first.error().code, again.error().code);
  }
}
INSTANTIATE_TEST_SUITE_P(
    SpotreadMeter, SpotreadDialogue,
    testing::Values(std::vector<std::string>{does::Print(test::kSpotreadSpectral)},
                    std::vector<std::string>{does::Print(test::kSpotreadNoSpectrum, 255),
                                             does::Print(test::kSpotreadOneChannel)},
                    std::vector<std::string>{does::AskToRetry(test::kSpotreadMisread)},
                    std::vector<std::string>{does::Print(test::kSpotreadCalibratedItself)},
                    std::vector<std::string>{does::Crash()}));

constexpr const char* kDisplayPro =
    "P: /devices/pci0000:00/usb1/1-4\n"
    "N: bus/usb/001/004\n"
    "E: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: BUSNUM=001\nE: DEVNUM=004\n"
    "E: DEVNAME=/dev/bus/usb/001/004\nE: MAJOR=189\nE: MINOR=3\n"
    "A: busnum=1\\n\nA: devnum=4\\n\nA: idVendor=0765\\n\nA: idProduct=5020\\n\n"
    "A: product=i1Display3\\n\n\n";

test::CliResult WithDisplayPro(const FakeSpotread& program, std::vector<std::string> arguments) {
  const std::string device = program.dir().Write("i1d3.umockdev", kDisplayPro);
  return test::RunLightcal(arguments, "", {program.Path()}, {"umockdev-run", "-d", device, "--"});
}

TEST(SpotreadMeter, IsListedWhileAnInstrumentIsPluggedInAndNotRunForThat) {
  const FakeSpotread program({does::Hang()});
  const auto listed = WithDisplayPro(program, {"devices", "--json"});
  EXPECT_THAT(listed.out, HasSubstr("\"spotread:" + program.program() + "\""));
  EXPECT_THAT(listed.out, HasSubstr("0765:5020"));
  EXPECT_THAT(program.Runs(), IsEmpty());
}

TEST(SpotreadMeter, IsReadByTheCommandLine) {
  const FakeSpotread program({does::Print(test::kSpotreadSpectral)});
  const auto read = WithDisplayPro(program, {"read", "--once", "--json", "--device", "spotread"});
  EXPECT_EQ(read.exit_code, 0) << read.err;
  EXPECT_THAT(read.out, HasSubstr("\"illuminance_lx\": 729.831"));
  EXPECT_THAT(read.out, HasSubstr("\"device\": \"spotread:1234567\""));
}

TEST(SpotreadMeter, IsDescribedByItsVersionAndTheInstrumentsPluggedIn) {
  const FakeSpotread program({does::Hang()});
  const std::string sister = program.dir().Write(
      "xicclu", "#!/bin/sh\necho 'Lookup ICC or CAL colors, Version 2.3.1' >&2\n");
  std::filesystem::permissions(sister, std::filesystem::perms::owner_all);
  FoundMeter found;
  found.row = FindDriver("spotread");
  found.address = program.program();
  EXPECT_THAT(found.row->describe(found), testing::StartsWith("ArgyllCMS 2.3.1; "));
  EXPECT_THAT(program.Runs(), IsEmpty());
}

}  // namespace
}  // namespace lightcal::devices::spotread
