// SPDX-License-Identifier: Apache-2.0
// Bulk and interrupt instruments through libusb.
#include "lightcal_devices/meters/lines.h"
#include "lightcal_devices/transport/usb.h"

namespace lightcal::devices {
namespace {

MeterAccess AccessOf(UsbAccess access) {
  switch (access) {
    case UsbAccess::kReady:
      return MeterAccess::kReady;
    case UsbAccess::kNoPermission:
      return MeterAccess::kNoPermission;
    case UsbAccess::kBusy:
      return MeterAccess::kBusy;
  }
  return MeterAccess::kReady;
}

Result<std::vector<FoundMeter>> FindUsb(const MeterRow& row) {
  std::vector<FoundMeter> found;
  for (const UsbId& id : row.usb) {
    auto devices = ListUsbDevices(id.vendor, id.product);
    if (!devices) return Propagate(std::move(devices));
    for (const UsbDeviceInfo& device : *devices) {
      FoundMeter meter;
      meter.row = &row;
      meter.address = device.port;
      meter.serial = device.serial;
      meter.usb = UsbIdText(id.vendor, id.product);
      meter.access = AccessOf(device.access);
      found.push_back(std::move(meter));
    }
  }
  return found;
}

Result<std::unique_ptr<Transport>> OpenFoundUsb(const FoundMeter& meter) {
  for (const UsbId& id : meter.row->usb) {
    auto devices = ListUsbDevices(id.vendor, id.product);
    if (!devices) return Propagate(std::move(devices));
    for (const UsbDeviceInfo& device : *devices) {
      if (device.port == meter.address) return OpenUsb(device);
    }
  }
  return Failed(std::string(fault::kNoDevice), "usb at " + meter.address,
                "no such device; is it plugged in?");
}

std::string UdevRuleOfUsb(UsbId id) {
  const std::string text = UsbIdText(id.vendor, id.product);
  return R"(SUBSYSTEM=="usb", ENV{DEVTYPE}=="usb_device", ATTR{idVendor}==")" + text.substr(0, 4) +
         R"(", ATTR{idProduct}==")" + text.substr(5) + R"(", MODE="0660", TAG+="uaccess")";
}

}  // namespace

const MeterLine kUsbLine = {.name = "usb",
                            .find = FindUsb,
                            .open = OpenFoundUsb,
                            .udev_rule = UdevRuleOfUsb,
                            .takes_address = false,
                            .tells_meters_apart = true,
                            .permission_remedy = ""};

}  // namespace lightcal::devices
