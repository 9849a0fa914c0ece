// SPDX-License-Identifier: Apache-2.0
// Programs that speak to instruments: there when PATH has one of the driver's name.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "lightcal_devices/meters/lines.h"
#include "lightcal_devices/transport/process.h"
#include "lightcal_devices/transport/sysfs.h"

namespace lightcal {
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

// Whether we may open none of the row's instruments that are plugged in.
bool AllForbidden(const MeterRow& row) {
  int plugged = 0;
  int permitted = 0;
  for (const SysfsUsbDevice& device : UsbDevicesInSysfs()) {
    const bool ours = std::ranges::any_of(row.usb, [&](const UsbId& id) {
      return id.vendor == device.vendor && id.product == device.product;
    });
    if (!ours || device.node.empty()) continue;
    ++plugged;
    if (::access(device.node.c_str(), R_OK | W_OK) == 0) ++permitted;
  }
  return plugged > 0 && permitted == 0;
}

Result<std::vector<FoundMeter>> FindProgram(const MeterRow& row) {
  std::vector<FoundMeter> found;
  const auto path = ProgramOnPath(row.driver);
  if (!path) return found;
  FoundMeter meter;
  meter.row = &row;
  meter.address = *path;
  if (AllForbidden(row)) meter.access = MeterAccess::kNoPermission;
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

}  // namespace lightcal
