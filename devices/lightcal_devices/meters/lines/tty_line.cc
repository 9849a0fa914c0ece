// SPDX-License-Identifier: Apache-2.0
// Meters on serial ports. A port tells the chip of its adapter, never the instrument behind it.
#include <algorithm>

#include "lightcal_devices/meters/lines.h"
#include "lightcal_devices/transport/tty.h"
#include "lightcal_devices/transport/usb.h"

namespace lightcal::devices {
namespace {

Result<std::vector<FoundMeter>> FindTty(const MeterRow& row) {
  std::vector<FoundMeter> found;
  if (row.usb.empty()) return found;
  for (const SerialPortInfo& port : ListSerialPorts()) {
    const bool fits = std::ranges::any_of(row.usb, [&](const UsbId& id) {
      return id.vendor == port.vendor && id.product == port.product;
    });
    if (!fits) continue;
    FoundMeter meter;
    meter.row = &row;
    meter.address = port.path;  // its serial number is the adapter's, not the meter's
    meter.usb = UsbIdText(port.vendor, port.product);
    if (port.permitted) {
      meter.remedy =
          "a serial port does not tell which meter hangs on it; if it is this one, name it: "
          "{ReadMeter} {meter.device} " +
          std::string(row.driver) + ":" + port.path;
    } else {
      meter.access = MeterAccess::kNoPermission;
    }
    found.push_back(std::move(meter));
  }
  return found;
}

Result<std::unique_ptr<Transport>> OpenFoundTty(const FoundMeter& meter) {
  return OpenTty(meter.address, meter.row->serial);
}

// A cable's chip is a thousand other devices' too: its ports stay the group's.
std::string NoRuleForCables(UsbId /*id*/) { return ""; }

}  // namespace

const MeterLine kTtyLine = {
    .name = "tty",
    .find = FindTty,
    .open = OpenFoundTty,
    .udev_rule = NoRuleForCables,
    .takes_address = true,
    .tells_meters_apart = false,
    .permission_remedy =
        "join the group dialout (sudo usermod -aG dialout $USER, then log in anew)"};

}  // namespace lightcal::devices
