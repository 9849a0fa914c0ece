// SPDX-License-Identifier: Apache-2.0
// lightcal read and devices on serial meters and sources of lux: the built binary on a port
// recorded for umockdev, on pseudo-terminals, FIFOs and programs.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "fake_gossen.h"
#include "fake_konica.h"
#include "run_cli.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::vector<std::string> OnTheRecordedPort(const std::string& script) {
  const std::string folder = std::string(LIGHTCAL_SOURCE_DIR) + "/tests/devices/recordings/";
  return {"umockdev-run",
          "-d",
          folder + "mavo.umockdev",
          "-s",
          "/dev/ttyUSB0=" + folder + script,
          "--"};
}

CliResult ReadOnce(const std::string& device, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"read", "--once", "--json", "--device", device};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return RunLightcal(arguments);
}

TEST(ReadSerial, ARecordedGossenIsRead) {
  const CliResult result =
      RunLightcal({"read", "--once", "--json", "--device", "gossen:/dev/ttyUSB0"}, "", {},
                  OnTheRecordedPort("mavo.script"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json reading = json::parse(result.out);
  EXPECT_EQ(reading["illuminance_lx"], 123.4);
  EXPECT_EQ(reading["quality"], "photometer");
  EXPECT_EQ(reading["device"], "gossen:20387");
}

TEST(ReadSerial, ARecordedFaultIsAnErrorOfTheDevice) {
  const CliResult result =
      RunLightcal({"read", "--once", "--json", "--device", "gossen:/dev/ttyUSB0"}, "", {},
                  OnTheRecordedPort("mavo_fault.script"));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], "hardware_error");
}

TEST(ReadSerial, APortIsListedForEachMeterItMayBeAndSaysThatItDoesNotTell) {
  const CliResult result =
      RunLightcal({"devices", "--json"}, "", {}, OnTheRecordedPort("mavo.script"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::vector<std::string> ids;
  const json document = json::parse(result.out);
  for (const json& device : document["devices"]) {
    if (device.value("usb", "") != "0403:6001") continue;
    ids.push_back(device["id"]);
    EXPECT_EQ(device["transport"], "tty");
    EXPECT_EQ(device["status"], "ready");
    EXPECT_THAT(device["remedy"], HasSubstr("a serial port does not tell which meter"));
  }
  EXPECT_THAT(ids, testing::IsSupersetOf({"gossen:/dev/ttyUSB0", "konica_t10a:/dev/ttyUSB0",
                                          "konica_cl200a:/dev/ttyUSB0"}));
}

TEST(ReadSerial, ACl200aIsReadRecordedAndReplayed) {
  const SerialStandIn port("\r\n", KonicaAnswers(kCl200aBodies));
  const TempDir dir;
  const std::string tape = dir.path() + "/cl200a.tape";
  const CliResult live = ReadOnce("konica_cl200a:" + port.path(), {"--record", tape});
  ASSERT_EQ(live.exit_code, 0) << live.err;
  json reading = json::parse(live.out);
  EXPECT_EQ(reading["illuminance_lx"], 27.3);
  EXPECT_EQ(reading["cct_K"], 3067.0);
  EXPECT_EQ(reading["color_source"], "colorimeter");
  const CliResult replay = RunLightcal({"read", "--once", "--json", "--replay", tape});
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  json again = json::parse(replay.out);
  again.erase("time");  // a tape knows when it began
  reading.erase("time");
  EXPECT_EQ(again, reading);
}

TEST(ReadSerial, ASilentMeterIsATimeoutThatSaysWhatToLookAt) {
  const SerialStandIn port("\r\n", KonicaAnswers({}));
  const CliResult result = ReadOnce("konica_t10a:" + port.path(), {"--timeout", "100ms"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], "timeout");
  EXPECT_THAT(json::parse(result.out)["error"]["message"].get<std::string>(),
              HasSubstr("switched on"));
}

TEST(ReadSource, AProgramThatPrintsLuxIsRead) {
  const CliResult result = ReadOnce("line:!printf '# lux\\n192lx,5600K\\n'", {"--set", "sigma=5%"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json reading = json::parse(result.out);
  EXPECT_EQ(reading["illuminance_lx"], 192.0);
  EXPECT_EQ(reading["cct_K"], 5600.0);
  EXPECT_EQ(reading["sigma_relative"], 0.05);
  EXPECT_EQ(reading["quality"], "bare_sensor");
}

constexpr const char* kStatedMeter =
    "lightcal = 1\n[room]\ndark = true\n[[light]]\nname = \"key\"\nkind = \"point\"\n"
    "[[meter]]\nname = \"m\"\nsigma_relative = 0.02\n[[meter]]\nname = \"plain\"\n";

json LastRow(const TempDir& dir) {
  std::istringstream lines(ReadFile(dir.path() + "/readings.jsonl"));
  std::string last;
  for (std::string line; std::getline(lines, line);) last = line;
  return json::parse(last);
}

CliResult ReadByProgram(const TempDir& dir, std::vector<std::string> more) {
  std::vector<std::string> all = {"read", "-s", dir.path(), "--distance",    "1m",
                                  "-n",   "1",  "--device", "line:!echo 120"};
  all.insert(all.end(), more.begin(), more.end());
  return RunLightcal(all);
}

TEST(ReadSource, WhatIsStatedOfTheMeterIsHeardTheNearestFirst) {
  const TempDir dir;
  dir.Write("session.toml", kStatedMeter);
  const CliResult stated = ReadByProgram(dir, {"--meter", "m"});
  ASSERT_EQ(stated.exit_code, 0) << stated.err;
  EXPECT_EQ(stated.err.find("warning"), std::string::npos) << stated.err;
  EXPECT_FALSE(LastRow(dir).contains("sigma_relative")) << "the session's 2 % counts";
  ASSERT_EQ(ReadByProgram(dir, {"--meter", "m", "--set", "sigma=7%"}).exit_code, 0);
  EXPECT_EQ(LastRow(dir)["sigma_relative"], 0.07);
  ASSERT_EQ(ReadByProgram(dir, {"--meter", "plain"}).exit_code, 0);
  EXPECT_EQ(LastRow(dir)["sigma_relative"], 0.3) << "that [[meter]] states none";
  const std::string calibration =
      "lightcal = 1\n[[calibration]]\ndevice = \"line:text\"\nfactor = 1.1\n";
  dir.Write("meters.toml", calibration);
  const CliResult guessed = ReadByProgram(dir, {});
  EXPECT_THAT(guessed.err, HasSubstr("write sigma_relative beside the factor"));
  dir.Write("meters.toml", calibration + "sigma_relative = 0.05\n");
  EXPECT_EQ(ReadByProgram(dir, {}).err.find("warning"), std::string::npos);
  EXPECT_EQ(LastRow(dir)["sigma_relative"], 0.05);
  ASSERT_EQ(ReadByProgram(dir, {"--meter", "m"}).exit_code, 0);
  EXPECT_FALSE(LastRow(dir).contains("sigma_relative"));
}

TEST(ReadSource, WhatCameInAPauseIsNotReadAsIfItWereNew) {
  const TempDir dir;
  dir.Write("session.toml", kStatedMeter);
  // Seconds since it began, 50 times a second.
  const std::string clock =
      "line:!i=0; while [ $i -lt 200 ]; do echo $i; i=$((i+1)); sleep 0.02; done";
  ASSERT_EQ(RunLightcal({"read", "-s", dir.path(), "--distance", "1m", "--device", clock, "-n", "1",
                         "--repeat", "2", "--every", "500ms"})
                .exit_code,
            0);
  EXPECT_GE(double(LastRow(dir)["illuminance_lx"]), 10.0) << "not the line after the first";
}

TEST(ReadSource, AFileThatIsNoTapeIsNamedBeforeAnythingIsMeasured) {
  const TempDir dir;
  const std::string notes = dir.Write("notes.txt", "mine\n");
  const std::string ran = dir.path() + "/ran";
  const CliResult result = ReadOnce("line:!touch " + ran + "; echo 5", {"--record", notes});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], "exists");
  EXPECT_THAT(json::parse(result.out)["error"]["message"].get<std::string>(),
              testing::Not(HasSubstr("--force")));
  EXPECT_EQ(ReadFile(ran), "") << "it was not started";
}

TEST(ReadSource, AProgramThatFailsOrBabblesIsAnError) {
  const CliResult failed = ReadOnce("line:!exit 3");
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_EQ(json::parse(failed.out)["error"]["code"], "ended");
  const CliResult babble = ReadOnce("line:!yes hello");
  EXPECT_EQ(babble.exit_code, 1);
  EXPECT_EQ(json::parse(babble.out)["error"]["code"], "bad_reply");
}

TEST(ReadSource, TypedTextIsADeviceToo) {
  const CliResult result = ReadOnce("typed:17.8fc");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NEAR(double(json::parse(result.out)["illuminance_lx"]), 191.5976, 1e-3);
}

}  // namespace
}  // namespace lightcal::test
