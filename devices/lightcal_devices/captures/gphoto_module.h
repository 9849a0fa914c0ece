// SPDX-License-Identifier: Apache-2.0
// The door to libgphoto2: what the module lightcal_tether.so answers. Both sides are built
// together.
#pragma once

#include <string>

#include "lightcal_devices/captures/tether.h"

namespace lightcal::devices {

// The camera at this port, to be deleted by the caller, or null with `error` filled in.
using GphotoOpen = TetheredCamera* (*)(const FoundCamera& camera, Error& error) noexcept;
inline constexpr const char* kGphotoOpenSymbol = "lightcal_gphoto_open";
inline constexpr const char* kGphotoModuleName = "lightcal_tether.so";

}  // namespace lightcal::devices
