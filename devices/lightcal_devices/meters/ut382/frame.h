// SPDX-License-Identifier: Apache-2.0
// Bytes of the UNI-T UT382 as what its display shows. Pure: no wire, no clock.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/meters/display.h"

namespace lightcal::devices::ut382 {

// 30 bytes 3n, carriage return, line feed. A further byte, whose meaning nobody knows, follows each
// frame and is left to the search for the next one.
inline constexpr std::size_t kFrameBytes = 32;

// Whether these could be the first bytes of a frame.
[[nodiscard]] bool MayBeginFrame(std::span<const std::byte> bytes);

struct Display {
  DisplayedIlluminance shown;  // unless in_menu or overload
  bool overload = false;       // the display says OL
  bool in_menu = false;        // it shows a menu, no measurement
  bool automatic_range = false;
  bool battery_low = false;
  std::string_view frozen;  // "HOLD", "MAX", "MIN": not what the light is now; "" = live
};
// Fails: bad_reply (another length or form, segments that are no digit, two decimal points, no
// unit).
[[nodiscard]] Result<Display> DecodeDisplay(std::span<const std::byte> bytes);

}  // namespace lightcal::devices::ut382
