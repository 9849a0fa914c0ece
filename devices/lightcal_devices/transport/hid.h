// SPDX-License-Identifier: Apache-2.0
// HID devices through hidapi 0.13, which no other file includes. Its two back ends export the same
// symbols, so each is opened on first use and keeps them to itself.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

enum class HidBackend {
  kHidraw,  // the kernel's /dev/hidraw*: for devices whose kernel driver leaves one
  kLibusb,  // takes the interface from the kernel's driver while open, and gives it back
};

enum class HidAccess { kReady, kNoPermission, kBusy };

// One top-level or nested collection of one HID interface (kHidraw), or one HID interface (kLibusb,
// which knows no usages: both are 0).
struct HidDeviceInfo {
  HidBackend backend = HidBackend::kHidraw;
  std::string path;  // "/dev/hidraw0", or the interface in sysfs: "1-1.4:1.2"
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string serial;         // "" = the device has none
  std::string name;           // "ColorHugALS", "" = unknown
  int interface_number = -1;  // -1 = not on USB
  std::uint16_t usage_page = 0;
  std::uint16_t usage = 0;
  std::string node;           // the file that must be writable: "/dev/hidraw0"
  std::string sysfs_parent;   // HidFolderOf its place in sysfs, "" = unknown
  std::string kernel_driver;  // of the HID device: "mcp2221", "hid-generic", "" = none
  HidAccess access = HidAccess::kReady;
};

// Nothing is sent. Empty when there is none. Fails: io.
[[nodiscard]] Result<std::vector<HidDeviceInfo>> ListHidraw();
// The HID interfaces of the USB devices with this id, read from sysfs. kBusy when another program
// holds the interface. Nothing is sent. Fails: never today.
[[nodiscard]] Result<std::vector<HidDeviceInfo>> ListUsbHid(std::uint16_t vendor,
                                                            std::uint16_t product);

// The first folder of `path` that is a HID device of the kernel, named bus:vendor:product.number:
// "/sys/devices/.../0003:273F:1008.0001/iio:device0" -> "/sys/devices/.../0003:273F:1008.0001".
// Two entries with the same folder are one sensor. "" = there is none.
[[nodiscard]] std::string HidFolderOf(std::string_view path);

// Longest input, output or feature report, its number included: the kernel's limit.
inline constexpr std::size_t kLongestHidReport = 4096;

// Opens the device; hidapi then owns it until the transport ends.
//   Write    one output report: its number (0 = the device has no numbers), then its bytes
//   Read     one input report, its number first when the device has numbers
//   Control  "report_descriptor": the descriptor (kHidraw, from sysfs; the bytes sent are ignored)
//            "get_feature", "get_input": the report whose number is the one byte sent
//            "set_feature": number and bytes; nothing comes back
// Fails: no_device, no_permission, busy, unplugged, timeout (Read), io.
[[nodiscard]] Result<std::unique_ptr<Transport>> OpenHid(const HidDeviceInfo& device);

}  // namespace lightcal::devices
