// SPDX-License-Identifier: Apache-2.0
// One sensor that two drivers find, under umockdev: the kernel's own way to it is kept.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "run_cli.h"

namespace lightcal::devices {
namespace {

constexpr const char* kHidFolder =
    "/devices/pci0000:00/0000:00:14.0/usb1/1-5/1-5:1.0/0003:273F:1008.0001";

std::string HidSensor() {
  const std::string folder = kHidFolder;
  return "P: " + folder + "/hidraw/hidraw0\nN: hidraw0\nE: DEVNAME=/dev/hidraw0\nE: MAJOR=240\n" +
         "E: MINOR=0\nE: SUBSYSTEM=hidraw\nA: dev=240:0\\n\nL: "
         "device=../../../0003:273F:1008.0001" +
         "\n\nP: " + folder + "\nE: SUBSYSTEM=hid\nE: DRIVER=hid-sensor-hub\n" +
         "E: HID_ID=0003:0000273F:00001008\nE: HID_NAME=ColorHugALS\nE: HID_UNIQ=\n" +
         "A: uevent=HID_ID=0003:0000273F:00001008\\nHID_NAME=ColorHugALS\\nHID_UNIQ=\\n\n" +
         "H: report_descriptor="
         "05200901A1010941A10085010AD104150026FFFF75209501550E8102C0C0\n\n";
}

std::string KernelSensor() {
  return "P: " + std::string(kHidFolder) + "/HID-SENSOR-200041.1.auto/iio:device0\n" +
         "N: iio:device0\nE: DEVNAME=/dev/iio:device0\nE: DEVTYPE=iio_device\nE: SUBSYSTEM=iio\n" +
         "A: name=als\\n\nA: in_illuminance_raw=209\\n\nA: in_illuminance_scale=1.000000\\n\n" +
         "A: in_illuminance_offset=0\\n\n\n";
}

test::CliResult Under(const std::string& devices, const std::vector<std::string>& arguments) {
  const test::TempDir dir;
  const std::string file = dir.Write("machine.umockdev", devices);
  return test::RunLightcal(arguments, "", {}, {"umockdev-run", "-d", file, "--"});
}

std::vector<std::string> Drivers(const std::string& devices) {
  std::vector<std::string> drivers;
  const auto document = nlohmann::json::parse(Under(devices, {"devices", "--json"}).out);
  for (const auto& device : document["devices"]) drivers.push_back(device["driver"]);
  return drivers;
}

TEST(TwinSensors, TheKernelsOwnDriverIsListedAlone) {
  EXPECT_THAT(Drivers(KernelSensor() + HidSensor()), testing::ElementsAre("iio"));
  EXPECT_THAT(Drivers(KernelSensor()), testing::ElementsAre("iio"));
  EXPECT_THAT(Drivers(HidSensor()), testing::ElementsAre("hid_als"));
}

TEST(KernelSensor, IsReadByTheCommandLineThroughSysfs) {
  const auto read = Under(KernelSensor(), {"read", "--once", "--json"});
  ASSERT_EQ(read.exit_code, 0) << read.err;
  const auto reading = nlohmann::json::parse(read.out);
  EXPECT_EQ(reading["illuminance_lx"], 209.0);
  EXPECT_EQ(reading["quality"], "bare_sensor");
  EXPECT_EQ(reading["device"], "iio:als");
}

}  // namespace
}  // namespace lightcal::devices
