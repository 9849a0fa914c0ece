// SPDX-License-Identifier: Apache-2.0
// Which meters of the table are plugged in, and how to open one.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/meters/lines.h"

namespace lightcal::devices {

// Ids are filled in. Fails: io.
[[nodiscard]] Result<std::vector<FoundMeter>> FindMeters();

// The one meter that `wanted` means: an id, a driver's name, "driver:address" where its line takes
// an address, or "" for the only one there that is certain to be what it is taken for.
// Fails: no_device. Wrong usage: an unknown driver, or several meters that fit (lists their ids).
[[nodiscard]] Result<FoundMeter> ChooseMeter(const std::vector<FoundMeter>& found,
                                             std::string_view wanted);

// What lets a person use it ("" when it is ready): the udev rule, the program to close.
[[nodiscard]] std::string Remedy(const FoundMeter& meter);

// Opens its line. A meter another program holds is tried `kBusyRetries` times more, `pause` apart.
// Fails: no_permission (the message holds the udev rule), busy, no_device, io.
inline constexpr int kBusyRetries = 3;
[[nodiscard]] Result<std::unique_ptr<Transport>> OpenMeter(
    const FoundMeter& meter, std::chrono::milliseconds pause = std::chrono::milliseconds(200));

}  // namespace lightcal::devices
