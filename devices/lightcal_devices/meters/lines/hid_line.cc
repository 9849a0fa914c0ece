// SPDX-License-Identifier: Apache-2.0
// HID instruments: sensors known by their usage, through /dev/hidraw*; and devices known by their
// USB id, through libusb, because a driver of the kernel owns them.
#include "lightcal_devices/meters/lines.h"
#include "lightcal_devices/transport/hid.h"
#include "lightcal_devices/transport/usb.h"

namespace lightcal::devices {
namespace {

constexpr std::uint16_t kSensorPage = 0x20;
constexpr std::uint16_t kAmbientLight = 0x41;
constexpr std::string_view kMcp2221Driver = "mcp2221";

MeterAccess AccessOf(HidAccess access) {
  switch (access) {
    case HidAccess::kReady:
      return MeterAccess::kReady;
    case HidAccess::kNoPermission:
      return MeterAccess::kNoPermission;
    case HidAccess::kBusy:
      return MeterAccess::kBusy;
  }
  return MeterAccess::kReady;
}

FoundMeter Describe(const MeterRow& row, const HidDeviceInfo& device) {
  FoundMeter meter;
  meter.row = &row;
  meter.address = device.path;
  meter.serial = device.serial;
  meter.usb = UsbIdText(device.vendor, device.product);
  meter.sysfs_parent = device.sysfs_parent;
  meter.access = AccessOf(device.access);
  return meter;
}

std::string RuleFor(std::string_view subsystem, const std::string& id) {
  return "SUBSYSTEM==\"" + std::string(subsystem) + R"(", ATTRS{idVendor}==")" + id.substr(0, 4) +
         R"(", ATTRS{idProduct}==")" + id.substr(5) + R"(", MODE="0660", TAG+="uaccess")";
}

std::string HidrawRule(UsbId id) { return RuleFor("hidraw", UsbIdText(id.vendor, id.product)); }

std::string UsbRule(UsbId id) { return kUsbLine.udev_rule(id); }

// A sensor that is not on USB (a laptop's) has no USB id to match.
std::string RuleOf(const HidDeviceInfo& device) {
  if (device.interface_number >= 0) {
    return RuleFor("hidraw", UsbIdText(device.vendor, device.product));
  }
  return R"(SUBSYSTEM=="hidraw", KERNELS=="*:)" + UsbIdText(device.vendor, device.product) +
         R"(.*", MODE="0660", TAG+="uaccess")";
}

Result<std::vector<FoundMeter>> FindHidSensors(const MeterRow& row) {
  auto devices = ListHidraw();
  if (!devices) return Propagate(std::move(devices));
  std::vector<FoundMeter> found;
  for (const HidDeviceInfo& device : *devices) {
    if (device.usage_page != kSensorPage || device.usage != kAmbientLight) continue;
    FoundMeter meter = Describe(row, device);
    if (meter.access == MeterAccess::kNoPermission) {
      meter.remedy =
          "you may not open this sensor; put this line into /etc/udev/rules.d/70-lightcal.rules, "
          "run `sudo udevadm control --reload`, and plug it in again (or restart):\n" +
          RuleOf(device);
    }
    found.push_back(std::move(meter));
  }
  return found;
}

Result<std::unique_ptr<Transport>> OpenHidSensor(const FoundMeter& meter) {
  HidDeviceInfo device;
  device.path = meter.address;
  device.node = meter.address;
  auto devices = ListHidraw();
  if (!devices) return Propagate(std::move(devices));
  for (const HidDeviceInfo& listed : *devices) {
    if (listed.path == meter.address) device = listed;
  }
  return OpenHid(device);
}

Result<std::vector<FoundMeter>> FindHidBridges(const MeterRow& row) {
  std::vector<FoundMeter> found;
  for (const UsbId& id : row.usb) {
    auto devices = ListUsbHid(id.vendor, id.product);
    if (!devices) return Propagate(std::move(devices));
    for (const HidDeviceInfo& device : *devices) {
      FoundMeter meter = Describe(row, device);
      if (meter.access == MeterAccess::kReady && device.kernel_driver == kMcp2221Driver) {
        meter.remedy =
            "the kernel's driver hid_mcp2221 holds it; lightcal takes it over through libusb while "
            "it reads and gives it back (its /dev/i2c-* is away so long). If that fails: close the "
            "program that uses /dev/i2c-*, or unload the driver: sudo rmmod hid_mcp2221";
      }
      found.push_back(std::move(meter));
    }
  }
  return found;
}

Result<std::unique_ptr<Transport>> OpenHidBridge(const FoundMeter& meter) {
  for (const UsbId& id : meter.row->usb) {
    auto devices = ListUsbHid(id.vendor, id.product);
    if (!devices) return Propagate(std::move(devices));
    for (const HidDeviceInfo& device : *devices) {
      if (device.path != meter.address) continue;
      auto line = OpenHid(device);
      if (!line && line.error().code == fault::kBusy && !device.kernel_driver.empty()) {
        line.error().message += ", or unload the driver: sudo rmmod hid_" + device.kernel_driver;
      }
      return line;
    }
  }
  return Failed(std::string(fault::kNoDevice), "hid at " + meter.address,
                "no such device; is it plugged in?");
}

}  // namespace

const MeterLine kHidLine = {.name = "hid",
                            .find = FindHidSensors,
                            .open = OpenHidSensor,
                            .udev_rule = HidrawRule,
                            .takes_address = false,
                            .tells_meters_apart = true,
                            .permission_remedy = ""};

const MeterLine kHidUsbLine = {.name = "hid_usb",
                               .find = FindHidBridges,
                               .open = OpenHidBridge,
                               .udev_rule = UsbRule,
                               .takes_address = false,
                               .tells_meters_apart = true,
                               .permission_remedy = ""};

}  // namespace lightcal::devices
