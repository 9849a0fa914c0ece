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
