// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/hid_in_sysfs.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "lightcal_devices/transport/sysfs.h"
#include "lightcal_devices/transport/usb.h"

namespace lightcal::devices {
namespace {

namespace fs = std::filesystem;

constexpr std::uint8_t kHidClass = 0x03;

std::string RealPath(const std::string& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  return error ? path : real.string();
}

// The name of what the link `driver` of a device points to.
std::string DriverOf(const std::string& folder) {
  std::error_code error;
  const fs::path target = fs::read_symlink(folder + "/driver", error);
  return error ? "" : target.filename().string();
}

// An attribute that is a hexadecimal or decimal number; absent when it is not there.
std::optional<unsigned> NumberIn(const std::string& folder, std::string_view attribute, int base) {
  const auto text = ReadSysfsAttribute(folder, attribute);
  if (!text) return std::nullopt;
  unsigned value = 0;
  const auto parsed = std::from_chars(text->data(), text->data() + text->size(), value, base);
  if (parsed.ec != std::errc()) return std::nullopt;
  return value;
}

std::vector<std::string> FolderNamesIn(const std::string& parent) {
  std::vector<std::string> names = FoldersIn(parent);
  for (std::string& name : names) name = fs::path(name).filename().string();
  return names;
}

bool IsHidFolder(std::string_view name) {  // 0003:273F:1008.0001
  constexpr std::string_view kShape = "xxxx:xxxx:xxxx.xxxx";
  if (name.size() < kShape.size()) return false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char shape = i < kShape.size() ? kShape[i] : 'x';
    const bool is_hex = std::isxdigit(static_cast<unsigned char>(name[i])) != 0;
    if (shape == 'x' ? !is_hex : name[i] != shape) return false;
  }
  return true;
}

// "1-1.4:1.2" -> "1-1.4"; "" where there is no interface in the name.
std::string DeviceOfInterface(const std::string& interface) {
  const auto colon = interface.find(':');
  return colon == std::string::npos ? "" : interface.substr(0, colon);
}

// The kernel's HID device on a USB interface.
std::string HidDeviceUnder(const std::string& interface_folder) {
  for (const std::string& name : FolderNamesIn(interface_folder)) {
    if (IsHidFolder(name)) return interface_folder + "/" + name;
  }
  return "";
}

std::string UsbNode(const std::string& device_folder) {
  const unsigned bus = NumberIn(device_folder, "busnum", 10).value_or(0);
  const unsigned number = NumberIn(device_folder, "devnum", 10).value_or(0);
  std::array<char, 40> node{};
  std::snprintf(node.data(), node.size(), "/dev/bus/usb/%03u/%03u", bus, number);
  return node.data();
}

HidDeviceInfo DescribeUsbHid(const std::string& interface) {
  const std::string device_folder =
      std::string(kUsbDevicesInSysfs) + "/" + DeviceOfInterface(interface);
  const std::string folder = std::string(kUsbDevicesInSysfs) + "/" + interface;
  HidDeviceInfo info;
  info.backend = HidBackend::kLibusb;
  info.path = interface;
  info.serial = ReadSysfsAttribute(device_folder, "serial").value_or("");
  info.name = ReadSysfsAttribute(device_folder, "product").value_or("");
  info.interface_number = static_cast<int>(NumberIn(folder, "bInterfaceNumber", 16).value_or(0));
  info.node = UsbNode(device_folder);
  const std::string hid = HidDeviceUnder(folder);
  if (!hid.empty()) AddKernelDevice(hid, info);
  info.access = AccessTo(info.node);
  // usbfs is how the kernel says that a program, not a driver, holds the interface.
  if (info.access == HidAccess::kReady && DriverOf(folder) == "usbfs") {
    info.access = HidAccess::kBusy;
  }
  return info;
}

}  // namespace

HidAccess AccessTo(const std::string& node) {
  const bool forbidden = ::access(node.c_str(), R_OK | W_OK) != 0 && errno == EACCES;
  return forbidden ? HidAccess::kNoPermission : HidAccess::kReady;
}

void AddKernelDevice(const std::string& folder, HidDeviceInfo& info) {
  info.sysfs_parent = HidFolderOf(RealPath(folder));
  info.kernel_driver = DriverOf(folder);
}

std::string HidFolderOf(std::string_view path) {
  std::size_t begin = 0;
  while (begin < path.size()) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    if (IsHidFolder(path.substr(begin, end - begin))) return std::string(path.substr(0, end));
    begin = end + 1;
  }
  return "";
}

Result<std::vector<HidDeviceInfo>> ListUsbHid(std::uint16_t vendor, std::uint16_t product) {
  std::vector<HidDeviceInfo> found;
  for (const std::string& interface : FolderNamesIn(std::string(kUsbDevicesInSysfs))) {
    const std::string device = DeviceOfInterface(interface);
    if (device.empty()) continue;
    const std::string device_folder = std::string(kUsbDevicesInSysfs) + "/" + device;
    const std::string folder = std::string(kUsbDevicesInSysfs) + "/" + interface;
    if (NumberIn(device_folder, "idVendor", 16) != vendor ||
        NumberIn(device_folder, "idProduct", 16) != product ||
        NumberIn(folder, "bInterfaceClass", 16) != kHidClass) {
      continue;
    }
    HidDeviceInfo info = DescribeUsbHid(interface);
    info.vendor = vendor;
    info.product = product;
    found.push_back(std::move(info));
  }
  return found;
}

}  // namespace lightcal::devices
