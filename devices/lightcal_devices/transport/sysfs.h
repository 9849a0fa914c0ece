// SPDX-License-Identifier: Apache-2.0
// The attributes of a Linux device in sysfs, one small text file each, as a line.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

namespace fault {
inline constexpr std::string_view kNoAttribute = "no_attribute";  // the device has no such file
}  // namespace fault

// The longest content of an attribute: the kernel gives a page at most.
inline constexpr std::size_t kSysfsAttributeBytes = 4096;

// Where the devices of Industrial I/O sensors are.
inline constexpr std::string_view kIioDevices = "/sys/bus/iio/devices";
// Where USB devices and their interfaces are ("1-1.4", "1-1.4:1.2").
inline constexpr std::string_view kUsbDevicesInSysfs = "/sys/bus/usb/devices";

// The device whose attributes are the files of `folder` ("/sys/bus/iio/devices/iio:device0").
//   Write  an attribute's name (a file of the folder itself) chooses it; nothing is written
//   Read   its content, read anew each time; the kernel then asks the sensor.
// Fails: no_attribute, no_permission, busy, timeout (the sensor did not answer the kernel),
// unplugged (the folder is gone), io.
[[nodiscard]] std::unique_ptr<Transport> OpenSysfs(const std::string& folder);

// One attribute, without the newline at its end. Fails as OpenSysfs' Read.
[[nodiscard]] Result<std::string> ReadSysfsAttribute(const std::string& folder,
                                                     std::string_view attribute);

// What stands in a folder of sysfs, sorted, with its path; empty where there is no such folder.
[[nodiscard]] std::vector<std::string> FoldersIn(const std::string& path);

struct SysfsUsbInterface {
  std::uint8_t device_class = 0, subclass = 0;  // of the USB class codes
  std::string driver;  // of the kernel; "usbfs" = a program has claimed it, "" = none
};

// A USB device as the kernel read it when it was plugged in: nothing is opened or sent.
struct SysfsUsbDevice {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string name;    // of the maker, printable ASCII, "" = it has none
  std::string serial;  // likewise
  std::string node;    // "/dev/bus/usb/001/004"
  std::vector<SysfsUsbInterface> interfaces;
};
[[nodiscard]] std::vector<SysfsUsbDevice> UsbDevicesInSysfs();

}  // namespace lightcal::devices
