// SPDX-License-Identifier: Apache-2.0
// Which meters of the table are plugged in, and how to open one.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/meters/meter_table.h"
#include "lightcal_devices/transport/usb.h"

namespace lightcal {

struct FoundMeter {
  const MeterRow* row = nullptr;
  std::string id;  // "sekonic:<serial>", or "sekonic:<bus-port>" where it has none
  UsbDeviceInfo usb;
};

// Fails: io.
[[nodiscard]] Result<std::vector<FoundMeter>> FindMeters();

// The one meter that `wanted` means: an id, a driver's name, or "" for whichever is there.
// Fails: no_device. Wrong usage: an unknown driver, or several meters that fit (lists their ids).
[[nodiscard]] Result<FoundMeter> ChooseMeter(const std::vector<FoundMeter>& found,
                                             std::string_view wanted);

// Opens its line. A meter another program holds is tried `kBusyRetries` times more, `pause` apart.
// Fails: no_permission (the message holds the udev rule), busy, no_device, io.
inline constexpr int kBusyRetries = 3;
[[nodiscard]] Result<std::unique_ptr<Transport>> OpenMeter(
    const FoundMeter& meter, std::chrono::milliseconds pause = std::chrono::milliseconds(200));

}  // namespace lightcal
