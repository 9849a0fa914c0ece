// SPDX-License-Identifier: Apache-2.0
// Programs that speak to instruments on USB: there when PATH has one of the driver's name and an
// instrument of it is plugged in.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "lightcal_devices/meters/lines.h"
#include "lightcal_devices/transport/process.h"
#include "lightcal_devices/transport/sysfs.h"
#include "lightcal_devices/transport/usb.h"

namespace lightcal::devices {
namespace {

constexpr std::chrono::milliseconds kLongestRun{120000};
constexpr const char* kSerialExclusion = "ARGYLL_EXCLUDE_SERIAL_SCAN";

// ArgyllCMS talks to every serial port it may; another meter may hang there. Whoever sets the
// variable himself, be it to nothing, knows better.
std::string WithoutSerialPorts() {
  std::string ports;
  for (const std::string& path : FoldersIn("/dev")) {
    const bool serial = path.starts_with("/dev/ttyS") || path.starts_with("/dev/ttyUSB") ||
                        path.starts_with("/dev/ttyACM") || path.starts_with("/dev/rfcomm");
    if (serial) ports += (ports.empty() ? "" : ";") + path;
  }
  return std::string(kSerialExclusion) + "=" + ports;
}

// The row's instruments that are plugged in.
std::vector<SysfsUsbDevice> Plugged(const MeterRow& row) {
  std::vector<SysfsUsbDevice> devices = UsbDevicesInSysfs();
  std::erase_if(devices, [&](const SysfsUsbDevice& device) {
    return std::ranges::none_of(row.usb, [&](const UsbId& id) {
      return id.vendor == device.vendor && id.product == device.product;
    });
  });
  return devices;
}

bool MayOpen(const SysfsUsbDevice& device) {
  return device.node.empty() || ::access(device.node.c_str(), R_OK | W_OK) == 0;
}

// One, whichever instrument the program will choose; a program alone measures nothing.
Result<std::vector<FoundMeter>> FindProgram(const MeterRow& row) {
  std::vector<FoundMeter> found;
  const auto path = ProgramOnPath(row.driver);
  if (!path) return found;
  const auto plugged = Plugged(row);
  if (plugged.empty()) return found;
  FoundMeter meter;
  meter.row = &row;
  meter.address = *path;
  meter.usb = UsbIdText(plugged.front().vendor, plugged.front().product);
  if (std::ranges::none_of(plugged, MayOpen)) meter.access = MeterAccess::kNoPermission;
  found.push_back(std::move(meter));
  return found;
}

Result<std::unique_ptr<Transport>> OpenProgram(const FoundMeter& meter) {
  ProcessSettings settings;
  settings.program = meter.address;
  settings.environment = {"ARGYLL_NOT_INTERACTIVE=1"};
  if (std::getenv(kSerialExclusion) == nullptr) {
    settings.environment.push_back(WithoutSerialPorts());
  }
  settings.longest_run = kLongestRun;
  return OpenProcess(settings);
}

std::string UdevRuleOfInstrument(UsbId id) { return kUsbLine.udev_rule(id); }

}  // namespace

const MeterLine kProcessLine = {.name = "process",
                                .find = FindProgram,
                                .open = OpenProgram,
                                .udev_rule = UdevRuleOfInstrument,
                                .takes_address = true,
                                .tells_meters_apart = false,
                                .permission_remedy = ""};

}  // namespace lightcal::devices
