// SPDX-License-Identifier: Apache-2.0
// lightcal read and devices with HID instruments: the built binary through the real hidapi, on a
// recorded light sensor (hidraw) and a simulated I2C bridge (libusb).
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "hid_stand_in.h"
#include "run_cli.h"
#include "usb_stand_in.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::vector<std::string> RecordedSensor(const std::string& script) {
  const std::string folder = std::string(LIGHTCAL_SOURCE_DIR) + "/tests/devices/recordings/";
  std::vector<std::string> wrapper = {"umockdev-run", "-d", folder + "hid_als.umockdev", "-i",
                                      "/dev/hidraw0=" + folder + "hid_als.ioctl"};
  if (!script.empty()) {
    wrapper.insert(wrapper.end(), {"-s", "/dev/hidraw0=" + folder + script});
  }
  wrapper.emplace_back("--");
  return wrapper;
}

const std::vector<std::string> kReadSensor = {"read",   "--device",  "hid_als", "--once",
                                              "--json", "--timeout", "500ms"};

TEST(ReadHidSensor, ARecordedSensorReads123Lux) {
  const CliResult result = RunLightcal(kReadSensor, "", {}, RecordedSensor("hid_als.script"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json reading = json::parse(result.out);
  EXPECT_EQ(reading["illuminance_lx"], 123.45);
  EXPECT_EQ(reading["quality"], "bare_sensor");
  EXPECT_FALSE(reading.contains("cct_K"));
}

TEST(ReadHidSensor, ASilentSensorTimesOut) {
  const CliResult result = RunLightcal(kReadSensor, "", {}, RecordedSensor(""));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], "timeout") << result.err;
}

// The second comes late, so that a slow reader does not take both for one.
TEST(ReadHidSensor, ShortReportsAreABadReply) {
  auto patient = kReadSensor;
  patient.back() = "10s";
  const CliResult result = RunLightcal(patient, "", {}, RecordedSensor("hid_als_short.script"));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], "bad_reply") << result.err;
}

TEST(ReadHidSensor, WhatWasRecordedReplaysToTheSameReading) {
  const TempDir dir;
  const std::string tape = dir.path() + "/sensor.tape";
  auto record = kReadSensor;
  record.insert(record.end(), {"--record", tape});
  const CliResult live = RunLightcal(record, "", {}, RecordedSensor("hid_als.script"));
  const CliResult again = RunLightcal({"read", "--once", "--json", "--replay", tape});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  json expected = json::parse(live.out);
  json found = json::parse(again.out);
  expected.erase("time");
  found.erase("time");
  EXPECT_EQ(found, expected);
}

json DeviceOf(const std::string& driver, const std::vector<std::string>& wrapper = {}) {
  const CliResult result = RunLightcal({"devices", "--json"}, "", {}, wrapper);
  const json document = json::parse(result.out);
  for (const json& device : document["devices"]) {
    if (device["driver"] == driver) return device;
  }
  return {};
}

TEST(DevicesHid, ASensorIsListedByItsUsage) {
  const json device = DeviceOf("hid_als", RecordedSensor(""));
  EXPECT_EQ(device["id"], "hid_als:/dev/hidraw0");
  EXPECT_EQ(device["usb"], "273f:1008");
  EXPECT_EQ(device["status"], "ready");
}

Mcp2221Setting WithBh1750() {
  Mcp2221Setting setting;
  setting.chips[0x23] = Bh1750(41, nullptr);
  return setting;
}

const std::vector<std::string> kReadBh1750 = {"read",   "--device",      "mcp2221",
                                              "--set",  "sensor=bh1750", "--once",
                                              "--json", "--timeout",     "300ms"};

TEST(ReadBridge, TakesTheBridgeFromTheKernelsDriverAndGivesItBack) {
  const BridgeStandIn bridge(WithBh1750());
  const CliResult result = RunLightcal(kReadBh1750);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NEAR(double(json::parse(result.out)["illuminance_lx"]), 34.17, 5e-3);
  EXPECT_TRUE(bridge.driver_attached());
  EXPECT_TRUE(bridge.engine_idle());
}

struct FaultCase {
  const char* name;
  Mcp2221Setting::Fault fault;
  std::uint8_t command;
  const char* code;
};
void PrintTo(const FaultCase& fault_case, std::ostream* os) { *os << fault_case.name; }
class BridgeFault : public testing::TestWithParam<FaultCase> {};
TEST_P(BridgeFault, EndsWithItsCode) {
  auto setting = WithBh1750();
  setting.fault = GetParam().fault;
  setting.fault_command = GetParam().command;
  const BridgeStandIn bridge(setting);
  const CliResult result = RunLightcal(kReadBh1750);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], GetParam().code) << result.err;
}
using Fault = Mcp2221Setting::Fault;
INSTANTIATE_TEST_SUITE_P(ReadBridge, BridgeFault,
                         testing::Values(FaultCase{"Silent", Fault::kSilent, 0x40, "timeout"},
                                         FaultCase{"Short", Fault::kShort, 0x90, "bad_reply"},
                                         FaultCase{"BusHeld", Fault::kBusHeld, 0x90, "bus_fault"},
                                         FaultCase{"EngineBusy", Fault::kAlwaysBusy, 0x91, "busy"},
                                         FaultCase{"Unplugged", Fault::kUnplug, 0x90, "unplugged"}),
                         [](const auto& fault_case) { return std::string(fault_case.param.name); });

TEST(ReadBridge, AnAddressNobodyAcknowledgesIsSaid) {
  const BridgeStandIn bridge(Mcp2221Setting{});
  auto arguments = kReadBh1750;
  arguments.insert(arguments.end(), {"--set", "address=0x5c"});
  const CliResult result = RunLightcal(arguments);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], "i2c_nack") << result.err;
}

TEST(ReadBridge, ADriverThatWillNotLetGoIsBusyAndSaysHowToUnloadIt) {
  const BridgeStandIn bridge(WithBh1750(), {.driver_stays = true});
  const CliResult result = RunLightcal(kReadBh1750);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], "busy");
  EXPECT_THAT(result.err, HasSubstr("sudo rmmod hid_mcp2221"));
}

TEST(DevicesHid, ABridgeUnderTheKernelsDriverSaysWhatToDoAndIsNotSpokenTo) {
  const BridgeStandIn bridge(WithBh1750());
  const json device = DeviceOf("mcp2221");
  EXPECT_EQ(device["id"], "mcp2221:1-1:1.2");
  EXPECT_EQ(device["status"], "ready");
  EXPECT_THAT(device["remedy"].get<std::string>(), HasSubstr("sudo rmmod hid_mcp2221"));
  EXPECT_EQ(bridge.requests(), 0U);
}

TEST(DevicesHid, ABridgeHeldByAProgramIsBusy) {
  const BridgeStandIn bridge(WithBh1750(), {.held_by_another = true});
  EXPECT_EQ(DeviceOf("mcp2221")["status"], "busy");
}

TEST(DevicesHid, AForbiddenBridgeComesWithItsUdevRule) {
  const BridgeStandIn bridge(WithBh1750(), {.forbidden = true});
  const json device = DeviceOf("mcp2221", UsbStandIn::WithoutRootPowers());
  EXPECT_EQ(device["status"], "no_permission");
  EXPECT_THAT(device["remedy"].get<std::string>(), HasSubstr("ATTR{idVendor}==\"04d8\""));
}

}  // namespace
}  // namespace lightcal::test
