// SPDX-License-Identifier: Apache-2.0
// lightcal read and devices: the built binary, through the real libusb, on a meter that umockdev
// simulates with the replies captured from a real one; on tapes; and typed.
#include <gmock/gmock.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "run_cli.h"
#include "usb_stand_in.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kTape407lx = SampleData("tapes/sekonic_c800_407lx_4995K.tape");

constexpr const char* kSessionToml =
    "lightcal = 1\n"
    "[[light]]\nname = \"key\"\nkind = \"point\"\n"
    "[[light]]\nname = \"fill\"\nkind = \"point\"\n"
    "[[meter]]\nname = \"c800\"\nsigma_relative = 0.05\n";

SekonicSetting Sekonic(const char* reply = kReply407lx) {
  SekonicSetting setting;
  setting.measurement = RecordedReply(reply);
  setting.busy_polls_after = 1;
  return setting;
}

constexpr const char* kOneLamp = "lightcal = 1\n[[light]]\nname = \"desk\"\nkind = \"point\"\n";

struct SessionDir {
  TempDir dir;
  SessionDir() { dir.Write("session.toml", kSessionToml); }
  [[nodiscard]] std::vector<std::string> Read(std::vector<std::string> more) const {
    std::vector<std::string> all = {"read", "-s",         dir.path(), "--light",
                                    "key",  "--distance", "0.5m"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] std::vector<json> Journal() const {
    std::vector<json> rows;
    std::istringstream lines(ReadFile(dir.path() + "/readings.jsonl"));
    for (std::string line; std::getline(lines, line);) rows.push_back(json::parse(line));
    return rows;
  }
};

std::string ErrorCode(const CliResult& result) {
  return json::parse(result.out)["error"]["code"].get<std::string>();
}

TEST(ReadFromMeter, TheFirstCapturedReplyIs407LuxAt4995Kelvin) {
  const UsbStandIn meter(Sekonic());
  const CliResult result = RunLightcal({"read", "--device", "sekonic", "--once", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json reading = json::parse(result.out);
  EXPECT_NEAR(double(reading["illuminance_lx"]), 406.960, 5e-4);
  EXPECT_NEAR(double(reading["cct_K"]), 4995.02, 5e-3);
  EXPECT_NEAR(double(reading["duv"]), -0.00110, 5e-6);
  EXPECT_EQ(reading["color_source"], "spectrometer");
  EXPECT_EQ(reading["sigma_relative"], 0.05);
  EXPECT_EQ(reading["device"], "sekonic:C-800");
  EXPECT_FALSE(reading.contains("light"));
  EXPECT_FALSE(meter.remote());
}

TEST(ReadFromMeter, ARecordedUsbTraceReplaysByteForByte) {
  const TempDir dir;
  const std::string device = dir.Write("sekonic.umockdev", SekonicDescription(""));
  const std::string trace = dir.path() + "/sekonic.pcap";
  const std::string maker = std::string(LIGHTCAL_SOURCE_DIR) + "/tests/tools/make_usbmon_pcap.py";
  ASSERT_EQ(RunProgram({"/usr/bin/python3", maker, kTape407lx, trace}).exit_code, 0);
  const CliResult result = RunLightcal(
      {"read", "--device", "sekonic", "--once", "--json"}, "", {},
      {"umockdev-run", "-d", device, "-p", std::string(kSekonicSysfs) + "=" + trace, "--"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NEAR(double(json::parse(result.out)["illuminance_lx"]), 406.960, 5e-4);
}

TEST(ReadFromMeter, TheSpectrumIsGivenWhenAskedFor) {
  const UsbStandIn meter(Sekonic());
  const CliResult result = RunLightcal({"read", "--once", "--json", "--with-spectrum"});
  const json reading = json::parse(result.out);
  EXPECT_EQ(reading["spectrum_nm"].size(), 401U);
  EXPECT_EQ(reading["spectrum_W_m2_nm"].size(), 401U);
}

TEST(ReadFromMeter, TheMedianOfNGoesIntoTheJournalWithLightAndPlace) {
  const UsbStandIn meter(Sekonic());
  const SessionDir session;
  const CliResult result = RunLightcal(session.Read({"-n", "3"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("406.96 lx ± 9.8 %, 4995 K"));
  EXPECT_THAT(result.out, HasSubstr("median of 3"));
  const auto rows = session.Journal();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["light"], "key");
  EXPECT_EQ(rows[0]["distance_m"], 0.5);
  EXPECT_NEAR(double(rows[0]["illuminance_lx"]), 406.960, 5e-4);
  EXPECT_TRUE(rows[0].contains("time"));
  const auto commands = meter.commands();
  EXPECT_EQ(std::ranges::count(commands, "NR"), 3);
  EXPECT_EQ(std::ranges::count(commands, "RT0"), 3);
}

TEST(ReadFromMeter, FiveMeasurementsAreTheDefault) {
  const UsbStandIn meter(Sekonic());
  const SessionDir session;
  const json reading = json::parse(RunLightcal(session.Read({"--json"})).out);
  EXPECT_EQ(reading["measurements"], 5);
  EXPECT_EQ(reading["spread_relative"], 0.0);
}

struct FaultCase {
  const char* name;
  SekonicSetting (*setting)();
  const char* code;
  int exit_code;
};
void PrintTo(const FaultCase& fault_case, std::ostream* os) { *os << fault_case.name; }
class ReadFault : public testing::TestWithParam<FaultCase> {};
TEST_P(ReadFault, EndsWithItsCodeAndWritesNothing) {
  const UsbStandIn meter(GetParam().setting());
  const SessionDir session;
  const CliResult result = RunLightcal(session.Read({"--json", "--timeout", "100ms"}));
  EXPECT_EQ(result.exit_code, GetParam().exit_code) << result.err;
  EXPECT_EQ(ErrorCode(result), GetParam().code);
  EXPECT_FALSE(fs::exists(session.dir.path() + "/readings.jsonl"));
}
SekonicSetting Struck(const char* command, Fault fault) {
  auto setting = Sekonic();
  setting.fault_command = command;
  setting.fault = fault;
  return setting;
}
INSTANTIATE_TEST_SUITE_P(
    ReadFromMeter, ReadFault,
    testing::Values(FaultCase{"Nak", [] { return Struck("RM0", Fault::kNak); }, "nak", 1},
                    FaultCase{"Silent", [] { return Struck("NR", Fault::kSilent); }, "timeout", 1},
                    FaultCase{"Short", [] { return Struck("NR", Fault::kShort); }, "bad_reply", 1},
                    FaultCase{"Stall", [] { return Struck("NR", Fault::kStall); }, "stalled", 1},
                    FaultCase{"Unplugged", [] { return Struck("RM0", Fault::kUnplug); },
                              "unplugged", 1},
                    FaultCase{"WrongRing",
                              [] {
                                auto setting = Sekonic();
                                setting.ring = 1;
                                return setting;
                              },
                              "wrong_ring", 1}),
    [](const auto& fault_case) { return std::string(fault_case.param.name); });

TEST(ReadFromMeter, OverRangeIsKeptAsALimitAndSaid) {
  auto setting = Sekonic();
  setting.measurement = WithFloat(setting.measurement, 271, 250000.0F);
  const UsbStandIn meter(setting);
  const SessionDir session;
  const CliResult result = RunLightcal(session.Read({"-n", "1"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("> 200000 lx"));
  EXPECT_THAT(result.err, HasSubstr("neutral-density filter"));
  const auto rows = session.Journal();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["over_range"], true);
  EXPECT_EQ(rows[0]["illuminance_lx"], 200000.0) << "the limit, not the number shown";
  const CliResult strict = RunLightcal(session.Read({"-n", "1", "--strict", "--json"}));
  EXPECT_EQ(strict.exit_code, 3);
  EXPECT_EQ(ErrorCode(strict), "over_range");
  EXPECT_EQ(session.Journal().size(), 1U);
}

constexpr const char* kCalibration =
    "lightcal = 1\n[[calibration]]\ndevice = \"sekonic:C-800\"\nfactor = 1.1\n"
    "date = 2026-03-01\nsigma_relative = 0.02\n";

TEST(ReadCalibrated, TheFactorOfTheSessionsMetersFileIsAppliedAndNoted) {
  const SessionDir session;
  session.dir.Write("meters.toml", kCalibration);
  const CliResult result = RunLightcal(session.Read({"--replay", kTape407lx, "--json"}), "",
                                       {"SOURCE_DATE_EPOCH=1774000000"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json reading = json::parse(result.out);
  EXPECT_NEAR(double(reading["illuminance_lx"]), 1.1 * 406.960, 1e-3);
  EXPECT_EQ(reading["calibration_factor"], 1.1);
  EXPECT_EQ(reading["sigma_relative"], 0.02);
  EXPECT_EQ(session.Journal().front()["calibration_factor"], 1.1);
}

TEST(ReadCalibrated, ThePersonsOwnFileCountsWhereTheSessionSaysNothing) {
  const TempDir settings;
  settings.Write("lightcal/meters.toml", kCalibration);
  const std::vector<std::string> environment = {"XDG_CONFIG_HOME=" + settings.path()};
  const CliResult own =
      RunLightcal({"read", "--once", "--json", "--replay", kTape407lx}, "", environment);
  EXPECT_NEAR(double(json::parse(own.out)["illuminance_lx"]), 1.1 * 406.960, 1e-3);
  const SessionDir session;
  std::string other = kCalibration;
  other.replace(other.find("1.1"), 3, "0.9");
  session.dir.Write("meters.toml", other);
  const CliResult both =
      RunLightcal(session.Read({"--replay", kTape407lx, "--json"}), "", environment);
  EXPECT_NEAR(double(json::parse(both.out)["illuminance_lx"]), 0.9 * 406.960, 1e-3);
}

TEST(ReadCalibrated, AnOldCalibrationIsSaidAndABadFileRefused) {
  const SessionDir session;
  std::string text = kCalibration;
  text.replace(text.find("2026"), 4, "2019");
  session.dir.Write("meters.toml", text);
  const UsbStandIn meter(Sekonic());
  const CliResult old = RunLightcal(session.Read({"-n", "1"}));
  EXPECT_EQ(old.exit_code, 0);
  EXPECT_THAT(old.err, HasSubstr("was calibrated on 2019-03-01"));
  session.dir.Write("meters.toml", "lightcal = 1\n[[calibration]]\nfactor = 1\n");
  const CliResult bad = RunLightcal(session.Read({"-n", "1", "--json"}));
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_EQ(ErrorCode(bad), "bad_meters");
}

TEST(ReadSeries, RepeatWritesOneRowForEachReading) {
  const UsbStandIn meter(Sekonic());
  const SessionDir session;
  const CliResult result = RunLightcal(session.Read({"-n", "1", "--repeat", "4"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(session.Journal().size(), 4U);
  EXPECT_EQ(std::ranges::count(result.out, '\n'), 4);
  const CliResult json_result = RunLightcal(session.Read({"-n", "1", "--repeat", "2", "--json"}));
  EXPECT_EQ(json::parse(json_result.out)["repeated"], 2);
  EXPECT_EQ(session.Journal().size(), 6U);
}

TEST(ReadSeries, SettleWaitsForSixSteadyMeasurements) {
  const TempDir dir;
  const std::string tape = dir.path() + "/seven.tape";
  {
    const UsbStandIn meter(Sekonic());
    ASSERT_EQ(RunLightcal({"read", "-n", "7", "--record", tape, "--once"}).exit_code, 2)
        << "--once is one measurement";
    const SessionDir session;
    ASSERT_EQ(RunLightcal(session.Read({"-n", "7", "--record", tape})).exit_code, 0);
  }
  const CliResult settled = RunLightcal({"read", "--once", "--json", "--settle", "--replay", tape});
  EXPECT_EQ(settled.exit_code, 0) << settled.err;
  EXPECT_EQ(std::ranges::count(settled.err, '\n'), 7) << settled.err;  // a sentence, six readings
  EXPECT_EQ(json::parse(settled.out)["measurements"], 1);
}

TEST(ReadFromMeter, AStoredReadingOfAC7000ComesFromItsMemory) {
  auto setting = Sekonic();
  setting.model = "C-7000";
  setting.memory = {RecordedReply(kReply14lx), RecordedReply(kReply407lx)};
  const UsbStandIn meter(setting);
  const CliResult result = RunLightcal({"read", "--once", "--json", "--from-memory", "1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NEAR(double(json::parse(result.out)["illuminance_lx"]), 406.960, 5e-4);
  EXPECT_THAT(result.err, HasSubstr("was never tried on one"));
  const CliResult none = RunLightcal({"read", "--once", "--json", "--from-memory", "2"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_EQ(ErrorCode(none), "no_such_reading");
}

TEST(ReadSeries, AnUnknownSettingNamesThoseThereAre) {
  const CliResult result =
      RunLightcal({"read", "--once", "--replay", kTape407lx, "--set", "gain=3"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("sekonic"));
}

TEST(ReadFromMeter, AMeterHeldByAnotherProgramIsBusy) {
  const UsbStandIn meter(Sekonic(), {.serial = "", .held_by_another = true});
  const CliResult result = RunLightcal({"read", "--once", "--json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(ErrorCode(result), "busy");
}

TEST(ReadFromMeter, WithoutPermissionTheUdevRuleIsPrinted) {
  const UsbStandIn meter(Sekonic(), {.serial = "", .forbidden = true});
  const CliResult result =
      RunLightcal({"read", "--once", "--json"}, "", {}, UsbStandIn::WithoutRootPowers());
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_EQ(ErrorCode(result), "no_permission");
  EXPECT_THAT(result.err, HasSubstr("ATTR{idVendor}==\"0a41\", ATTR{idProduct}==\"7003\""));
}

TEST(ReadFromMeter, NoMeterIsADeviceErrorThatSaysWhatElseToDo) {
  const NoUsb machine;
  const CliResult result = RunLightcal({"read", "--once", "--json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(ErrorCode(result), "no_device");
  EXPECT_THAT(result.err, HasSubstr("--lux 192"));
}

TEST(ReadFromMeter, StrictRefusesAWarnedReadingBeforeWriting) {
  auto setting = Sekonic(kReply14lx);
  setting.measurement = WithFloat(setting.measurement, 50, 50000.0F);  // a CCT the C-800 has not
  const UsbStandIn meter(setting);
  const SessionDir session;
  const CliResult result = RunLightcal(session.Read({"-n", "1", "--strict", "--json"}));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(ErrorCode(result), "cct_out_of_range");
  EXPECT_THAT(session.Journal(), IsEmpty());
}

TEST(ReadFromMeter, CtrlCGivesTheMeterBackAndWritesNothing) {
  auto setting = Sekonic();
  setting.busy_polls_after = 1000000;
  const UsbStandIn meter(setting);
  const SessionDir session;
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::execl(LIGHTCAL_BINARY, "lightcal", "read", "-s", session.dir.path().c_str(), "--light", "key",
            "--distance", "0.5", "--quiet", nullptr);
    ::_exit(127);
  }
  const bool started = meter.WaitForCommand("RM0");
  ::kill(child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(started);
  ASSERT_TRUE(WIFEXITED(status)) << "killed instead of stopping by itself";
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_EQ(meter.commands().back(), "RT0");
  EXPECT_FALSE(meter.remote());
  EXPECT_THAT(session.Journal(), IsEmpty());
}

TEST(ReadTape, WhatWasRecordedReplaysToTheSameReading) {
  const TempDir dir;
  const std::string tape = dir.path() + "/meter.tape";
  CliResult live;
  {
    const UsbStandIn meter(Sekonic(), {.serial = "J0123"});
    live = RunLightcal({"read", "--once", "--json", "--record", tape});
  }
  ASSERT_EQ(live.exit_code, 0) << live.err;
  const CliResult played = RunLightcal({"read", "--once", "--json", "--replay", tape});
  EXPECT_EQ(played.exit_code, 0) << played.err;
  json expected = json::parse(live.out);
  json found = json::parse(played.out);
  EXPECT_EQ(found["device"], "sekonic:J0123");
  expected.erase("time");  // the tape says when it began, the reading when it was taken
  found.erase("time");
  EXPECT_EQ(found, expected);
}

TEST(ReadTape, AFailedDialogueIsRecordedToo) {
  const TempDir dir;
  const std::string tape = dir.path() + "/meter.tape";
  {
    const UsbStandIn meter(Struck("NR", Fault::kShort));
    EXPECT_EQ(RunLightcal({"read", "--once", "--record", tape}).exit_code, 1);
  }
  const CliResult played = RunLightcal({"read", "--once", "--json", "--replay", tape});
  EXPECT_EQ(played.exit_code, 1);
  EXPECT_EQ(ErrorCode(played), "bad_reply");
}

struct SampleTape {
  const char* tape;
  const char* reply;
  double illuminance_lx;
  double cct_K;
};
void PrintTo(const SampleTape& sample, std::ostream* os) { *os << sample.tape; }
class CommittedTape : public testing::TestWithParam<SampleTape> {};
TEST_P(CommittedTape, ReadsAsItsReplyIsKnownTo) {
  const std::string tape = SampleData(std::string("tapes/") + GetParam().tape);
  const json reading = json::parse(RunLightcal({"read", "--once", "--json", "--replay", tape}).out);
  EXPECT_NEAR(double(reading["illuminance_lx"]), GetParam().illuminance_lx, 5e-4);
  EXPECT_NEAR(double(reading["cct_K"]), GetParam().cct_K, 5e-3);
}
TEST_P(CommittedTape, SaysWhereItComesFrom) {
  const std::string tape = ReadFile(SampleData(std::string("tapes/") + GetParam().tape));
  EXPECT_THAT(tape, HasSubstr(std::string("made from the captured reply ") + GetParam().reply));
}
INSTANTIATE_TEST_SUITE_P(
    ReadTape, CommittedTape,
    testing::Values(SampleTape{"sekonic_c800_407lx_4995K.tape", kReply407lx, 406.960, 4995.02},
                    SampleTape{"sekonic_c800_14lx_3289K.tape", kReply14lx, 14.0775, 3288.61}),
    [](const auto& sample) { return sample.index == 0 ? "Reply407lx" : "Reply14lx"; });

TEST(ReadTape, IntoASessionItIsReadToItsEnd) {
  const SessionDir session;
  const CliResult result = RunLightcal(session.Read({"--replay", kTape407lx, "--json"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["measurements"], 1);
  EXPECT_EQ(session.Journal().size(), 1U);
}

TEST(ReadTape, ATapeOfAnotherDialogueShowsWhatWasExpected) {
  const TempDir dir;
  std::string text = ReadFile(kTape407lx);
  text.replace(text.find("RM0"), 3, "RM1");
  const CliResult result =
      RunLightcal({"read", "--once", "--json", "--replay", dir.Write("other.tape", text)});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(ErrorCode(result), "tape_mismatch");
  EXPECT_THAT(result.err, HasSubstr("expected write RM1, got write RM0"));
}

TEST(ReadTape, AnUnreadableTapeIsRefusedByItsLine) {
  const TempDir dir;
  const std::string bad = dir.Write(
      "bad.tape", "{\"schema\":\"lightcal.tape/1\",\"driver\":\"sekonic\"}\n{\"t_ms\":-1}\n");
  const CliResult result = RunLightcal({"read", "--once", "--json", "--replay", bad});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(ErrorCode(result), "bad_tape");
  EXPECT_THAT(result.err, HasSubstr("bad.tape:2"));
  EXPECT_EQ(RunLightcal({"read", "--once", "--replay", dir.path() + "/none"}).exit_code, 1);
}

TEST(ReadTyped, AColourTemperatureMayStandBesideTheNumber) {
  const SessionDir session;
  ASSERT_EQ(RunLightcal(session.Read({"--lux", "192lx,2900K"})).exit_code, 0);
  EXPECT_EQ(session.Journal().front()["illuminance_lx"], 192.0);
  EXPECT_EQ(session.Journal().front()["cct_K"], 2900.0);
  EXPECT_EQ(RunLightcal(session.Read({"--lux", "192,warm"})).exit_code, 2);
}

TEST(ReadTyped, TheOnlyLampNeedsNoNameAndAColourMetersDuvIsKept) {
  TempDir dir;
  dir.Write("session.toml", kOneLamp);
  const std::vector<std::string> line = {"read",  "-s",        dir.path(), "--distance", "0.5m",
                                         "--lux", "192,5600K", "--duv",    "0.004"};
  const CliResult result = RunLightcal(line);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json row = json::parse(ReadFile(dir.path() + "/readings.jsonl"));
  EXPECT_EQ(row["light"], "desk");
  EXPECT_EQ(row["cct_K"], 5600.0);
  EXPECT_EQ(row["duv"], 0.004);
  const SessionDir two;
  const CliResult unsaid =
      RunLightcal({"read", "-s", two.dir.path(), "--distance", "1", "--lux", "9"});
  EXPECT_EQ(unsaid.exit_code, 2);
  EXPECT_THAT(unsaid.err, AllOf(HasSubstr("--light"), HasSubstr("key"), HasSubstr("fill")));
}

TEST(ReadTyped, TheSunHasNoDistanceAndALampHasOne) {
  SessionDir sun;
  sun.dir.Write("session.toml",
                "lightcal = 1\n[[light]]\nname = \"sun\"\nkind = \"directional\"\n");
  const CliResult read = RunLightcal({"read", "-s", sun.dir.path(), "--lux", "50000"});
  ASSERT_EQ(read.exit_code, 0) << read.err;
  const std::vector<json> rows = sun.Journal();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["illuminance_lx"], 50000.0);
  EXPECT_FALSE(rows[0].contains("distance_m"));
  EXPECT_EQ(RunLightcal({"fit", sun.dir.path()}).exit_code, 0);
  const SessionDir lamps;
  const CliResult lamp =
      RunLightcal({"read", "-s", lamps.dir.path(), "--light", "key", "--lux", "9"});
  EXPECT_EQ(lamp.exit_code, 2);
  EXPECT_THAT(lamp.err, HasSubstr("give the distance from the lamp"));
}

// Somebody gives the answer for the question.
TEST(ReadTyped, ALightJsonGivenForASessionIsNamedAsOne) {
  const TempDir dir;
  dir.Write("light.json", "{\"schema\": \"lightcal.light/1\"}");
  const CliResult result = RunLightcal({"explain", dir.path() + "/light.json"});
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("is JSON, not a session"));
}

TEST(ReadTyped, AReadingTypedWrongIsTakenBackAndTheJournalKeepsBoth) {
  const SessionDir session;
  const auto undo = [&](std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"read", "-s", session.dir.path(), "--undo"});
    return RunLightcal(more);
  };
  const CliResult empty = undo({"--json"});
  EXPECT_EQ(empty.exit_code, 3);
  EXPECT_EQ(ErrorCode(empty), "nothing_to_undo");
  for (const char* lux : {"192", "1920", "53"}) {
    ASSERT_EQ(RunLightcal(session.Read({"--lux", lux})).exit_code, 0);
  }
  EXPECT_THAT(undo().out, HasSubstr("took back readings.jsonl:3: key 53.00 lx at 0.5000 m"));
  EXPECT_THAT(undo().out, HasSubstr("readings.jsonl:2: key 1920 lx"));
  ASSERT_EQ(RunLightcal(session.Read({"--lux", "194"})).exit_code, 0);
  // Nothing written is lost; two readings count.
  EXPECT_EQ(session.Journal().size(), 6U);
  const CliResult validated = RunLightcal({"validate", session.dir.path()});
  EXPECT_EQ(validated.exit_code, 0) << validated.out;
  EXPECT_THAT(validated.out, HasSubstr("2 readings"));
  EXPECT_EQ(undo().exit_code, 0);
  EXPECT_EQ(undo().exit_code, 0);
  EXPECT_EQ(undo().exit_code, 3);
  EXPECT_EQ(RunLightcal({"read", "--undo"}).exit_code, 2) << "of which session";
}

TEST(ReadTyped, ANumberBecomesARowOfTheJournal) {
  const SessionDir session;
  const CliResult result = RunLightcal(session.Read({"--lux", "17.8fc", "--meter", "c800"}), "",
                                       {"SOURCE_DATE_EPOCH=1763719200"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto rows = session.Journal();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_NEAR(double(rows[0]["illuminance_lx"]), 17.8 / (0.3048 * 0.3048), 1e-9);
  EXPECT_EQ(rows[0]["meter"], "c800");
  EXPECT_EQ(rows[0]["time"], "2025-11-21T10:00:00Z");
  EXPECT_FALSE(rows[0].contains("device"));
}

TEST(ReadTyped, AShadowCardIsSuggestedUntilThereIsOne) {
  const SessionDir session;
  const CliResult first = RunLightcal(session.Read({"--lux", "192"}));
  EXPECT_THAT(first.err, HasSubstr("--shadow-card"));
  const CliResult shadow = RunLightcal(session.Read({"--lux", "3.1", "--shadow-card"}));
  EXPECT_EQ(shadow.exit_code, 0) << shadow.err;
  EXPECT_THAT(shadow.err, Not(HasSubstr("--shadow-card")));
  const CliResult second = RunLightcal(session.Read({"--lux", "191"}));
  EXPECT_THAT(second.err, Not(HasSubstr("--shadow-card")));
  const auto rows = session.Journal();
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_FALSE(rows[0].contains("shadow_card"));
  EXPECT_EQ(rows[1]["shadow_card"], true);
}

TEST(ReadTyped, LightBeyondTheRangeIsALimit) {
  const SessionDir session;
  ASSERT_EQ(RunLightcal(session.Read({"--lux", ">20000"})).exit_code, 0);
  EXPECT_EQ(session.Journal().back()["over_range"], true);
  EXPECT_EQ(session.Journal().back()["illuminance_lx"], 20000.0);
  const CliResult overload = RunLightcal(session.Read({"--lux", "OL"}));
  EXPECT_EQ(overload.exit_code, 2);
  EXPECT_THAT(overload.err, HasSubstr(">20000"));
  const CliResult comma = RunLightcal(session.Read({"--lux", "1,5"}));
  EXPECT_EQ(comma.exit_code, 2);
  EXPECT_THAT(comma.err, HasSubstr("decimals have a point here, and thousands no sign: 1.5"));
}

TEST(ReadTyped, ALampThatIsOffIsSaidSo) {
  const SessionDir session;
  ASSERT_EQ(RunLightcal(session.Read({"--lux", "0.4", "--lamp-off"})).exit_code, 0);
  EXPECT_EQ(session.Journal()[0]["lamp"], "off");
}

struct BadInput {
  std::vector<std::string> arguments;  // with @ for the session
  int exit_code;
};
void PrintTo(const BadInput& input, std::ostream* os) {
  for (const std::string& word : input.arguments) *os << word << ' ';
}
class BadRead : public testing::TestWithParam<BadInput> {};
TEST_P(BadRead, IsRefusedAndNothingIsWritten) {
  const SessionDir session;
  std::vector<std::string> arguments = GetParam().arguments;
  std::ranges::replace(arguments, std::string("@"), session.dir.path());
  const CliResult result = RunLightcal(arguments);
  EXPECT_EQ(result.exit_code, GetParam().exit_code) << result.err;
  EXPECT_THAT(result.err, Not(IsEmpty()));
  EXPECT_FALSE(fs::exists(session.dir.path() + "/readings.jsonl"));
}
INSTANTIATE_TEST_SUITE_P(
    ReadTyped, BadRead,
    testing::Values(
        BadInput{{"read", "-s", "@", "--light", "kez", "--distance", "1", "--lux", "9"}, 3},
        BadInput{{"read", "-s", "@", "--light", "key", "--distance", "0", "--lux", "9"}, 3},
        BadInput{{"read", "-s", "@", "--light", "key", "--distance", "-1m", "--lux", "9"}, 3},
        BadInput{{"read", "-s", "@", "--light", "key", "--distance", "1", "--lux", "-9"}, 3},
        BadInput{{"read", "-s", "@", "--light", "key", "--distance", "1", "--lux", "nan"}, 2},
        BadInput{{"read", "-s", "@", "--light", "key", "--distance", "1", "--lux", "9m"}, 2},
        BadInput{{"read", "-s", "@", "--light", "key", "--lux", "9"}, 2},
        BadInput{{"read", "-s", "@", "--distance", "1", "--lux", "9"}, 2},
        BadInput{{"read", "--light", "key", "--distance", "1", "--lux", "9"}, 2},
        BadInput{
            {"read", "-s", "@", "--light", "key", "--distance", "1", "--lux", "9", "--duv", "0"},
            3},
        BadInput{{"read", "-s", "@", "--light", "key", "--distance", "1", "--lux", "9", "--meter",
                  "unknown"},
                 3},
        BadInput{{"read", "-s", "@", "--light", "key", "--distance", "1", "--lux", "9",
                  "--shadow-card", "--lamp-off"},
                 2},
        BadInput{{"read", "-s", "@", "--light", "key", "--distance", "1", "-n", "0"}, 2},
        BadInput{{"read", "-s", "@/none", "--light", "key", "--distance", "1", "--lux", "9"}, 1},
        BadInput{{"read", "--once", "--device", "sekonik"}, 2},
        BadInput{{"read", "--once", "--timeout", "0s", "--lux", "9"}, 2}));

// Runs the binary on a terminal of its own and types the answers.
CliResult RunOnTerminal(const std::vector<std::string>& arguments, const std::string& typed) {
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    std::vector<char*> argv = {const_cast<char*>("lightcal")};
    for (const std::string& word : arguments) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    ::execv(LIGHTCAL_BINARY, argv.data());
    ::_exit(127);
  }
  CliResult result;
  EXPECT_EQ(::write(terminal, typed.data(), typed.size()), static_cast<ssize_t>(typed.size()));
  std::array<char, 4096> buffer{};
  for (ssize_t n = 0; (n = ::read(terminal, buffer.data(), buffer.size())) > 0;) {
    result.out.append(buffer.data(), static_cast<std::size_t>(n));
  }
  ::close(terminal);
  int status = 0;
  ::waitpid(child, &status, 0);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

TEST(ReadOnTerminal, WithoutAMeterItAsksForShadowCardAndNumber) {
  const NoUsb machine;
  const SessionDir session;
  const CliResult result = RunOnTerminal(session.Read({}), "\n3.1\n\n192lx\n");
  ASSERT_EQ(result.exit_code, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr("hold a card"));
  const auto rows = session.Journal();
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["shadow_card"], true);
  EXPECT_EQ(rows[0]["illuminance_lx"], 3.1);
  EXPECT_EQ(rows[1]["illuminance_lx"], 192.0);
}

TEST(ReadOnTerminal, TheShadowCardMayBeSkipped) {
  const UsbStandIn meter(Sekonic());
  const SessionDir session;
  const CliResult result = RunOnTerminal(session.Read({"-n", "1"}), "s\n");
  ASSERT_EQ(result.exit_code, 0) << result.out;
  ASSERT_EQ(session.Journal().size(), 1U);
  EXPECT_FALSE(session.Journal()[0].contains("shadow_card"));
}

json Devices(const std::vector<std::string>& wrapper = {}) {
  const CliResult result = RunLightcal({"devices", "--json"}, "", {}, wrapper);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return json::parse(result.out)["devices"];
}

TEST(Devices, AMeterThatMayBeUsedIsReady) {
  const UsbStandIn meter(Sekonic(), {.serial = "J0123"});
  const json devices = Devices();
  ASSERT_EQ(devices.size(), 1U);
  EXPECT_EQ(devices[0]["id"], "sekonic:J0123");
  EXPECT_EQ(devices[0]["driver"], "sekonic");
  EXPECT_EQ(devices[0]["transport"], "usb");
  EXPECT_EQ(devices[0]["usb"], "0a41:7003");
  EXPECT_EQ(devices[0]["serial"], "J0123");
  EXPECT_EQ(devices[0]["status"], "ready");
  EXPECT_EQ(devices[0]["verified"], "captured_replay");
  EXPECT_THAT(meter.commands(), IsEmpty()) << "listing says nothing to the meter";
}

TEST(Devices, AMeterInUseIsBusy) {
  const UsbStandIn meter(Sekonic(), {.serial = "", .held_by_another = true});
  EXPECT_EQ(Devices()[0]["status"], "busy");
}

TEST(Devices, AForbiddenMeterComesWithItsUdevRule) {
  const UsbStandIn meter(Sekonic(), {.serial = "", .forbidden = true});
  const auto wrapper = UsbStandIn::WithoutRootPowers();
  EXPECT_EQ(Devices(wrapper)[0]["status"], "no_permission");
  const CliResult people = RunLightcal({"devices"}, "", {}, wrapper);
  EXPECT_THAT(people.out, HasSubstr("70-lightcal.rules"));
  EXPECT_THAT(people.out, HasSubstr("ATTR{idVendor}==\"0a41\""));
}

TEST(Devices, NoneFoundIsNoErrorAndSaysWhatToDo) {
  const NoUsb machine;
  EXPECT_THAT(Devices(), IsEmpty());
  const CliResult people = RunLightcal({"devices"});
  EXPECT_EQ(people.exit_code, 0);
  EXPECT_THAT(people.out, HasSubstr("No meter found"));
  EXPECT_THAT(people.out, HasSubstr("--lux 192"));
}

}  // namespace
}  // namespace lightcal::test
