// SPDX-License-Identifier: Apache-2.0
// USB bulk and interrupt instruments through libusb 1.0, which no other file includes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

enum class UsbAccess { kReady, kNoPermission, kBusy };

struct UsbDeviceInfo {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  int bus = 0;
  int address = 0;
  std::string port;    // bus and port path, "1-1.4": stays while the plug stays
  std::string serial;  // as the kernel read it (printable ASCII), "" = the device has none
  UsbAccess access = UsbAccess::kReady;
};

// Every IN transfer asks for this many bytes, whatever the caller's max: recorded USB traces
// (usbmon) replay only when each request has the recorded length. The longest reply known, a
// Sekonic measurement, has 2380 bytes.
inline constexpr std::size_t kUsbInBufferBytes = 4160;

// "0a41:7003"
[[nodiscard]] std::string UsbIdText(std::uint16_t vendor, std::uint16_t product);

// The devices with this id, each opened and claimed for a moment to learn whether it may be used;
// nothing is sent. Empty when there is none, or no USB on this machine. Fails: io.
[[nodiscard]] Result<std::vector<UsbDeviceInfo>> ListUsbDevices(std::uint16_t vendor,
                                                                std::uint16_t product);

// Opens the device and claims its first interface that has a bulk endpoint each way, or else the
// first that has an interrupt endpoint each way (endpoints are found by direction and type, never
// by number). The claim ends with the transport. A Read longer than its max fails as io; a stalled
// endpoint is cleared before the error is returned. Fails: no_device, no_permission, busy, io.
[[nodiscard]] Result<std::unique_ptr<Transport>> OpenUsb(const UsbDeviceInfo& device);

}  // namespace lightcal::devices
