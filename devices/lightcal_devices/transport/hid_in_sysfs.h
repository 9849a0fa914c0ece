// SPDX-License-Identifier: Apache-2.0
// What sysfs and the device's node say of a HID device, whichever back end lists it.
#pragma once

#include <string>

#include "lightcal_devices/transport/hid.h"

namespace lightcal::devices {

// The kernel's HID device, whose folder in sysfs this is or links to: sysfs_parent and
// kernel_driver of `info`.
void AddKernelDevice(const std::string& folder, HidDeviceInfo& info);

// kNoPermission where the node is there and may not be read and written; never kBusy.
[[nodiscard]] HidAccess AccessTo(const std::string& node);

}  // namespace lightcal::devices
