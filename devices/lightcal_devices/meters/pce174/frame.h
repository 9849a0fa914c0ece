// SPDX-License-Identifier: Apache-2.0
// Bytes of the PCE-174 and the Extech HD450 as values. Pure: no wire, no clock.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/meters/display.h"

namespace lightcal::devices::pce174 {

inline constexpr std::size_t kFrameBytes = 18;

// 87 83 11: send the current measurement.
inline constexpr std::array<std::byte, 3> kReadCommand = {std::byte{0x87}, std::byte{0x83},
                                                          std::byte{0x11}};

// Every range ends at 4000 counts: 400.0 lx, 4000 lx, 40.00 klx, 400.0 klx; 40.00 fc and so on.
inline constexpr int kHighestCounts = 4000;

// Whether these could be the first bytes of a reply: AA DD 00.
[[nodiscard]] bool MayBeginFrame(std::span<const std::byte> bytes);

struct Measurement {
  // The raw value: what is measured now, also in the mode REL. A number above kHighestCounts is
  // over its range.
  DisplayedIlluminance raw;
  bool negative = false;
  bool battery_low = false;
  // Why the number is not what the light is now: "HOLD", "PMIN", "PMAX", "MAX", "MIN", "REL",
  // "LOAD" (a stored value is shown); "" = it is.
  std::string_view mode;
};
// Layout: README.md. The clock in the frame is ignored: some meters keep impossible dates.
// Fails: bad_reply (another length or form, digits above 99, a mode nobody has documented).
[[nodiscard]] Result<Measurement> DecodeMeasurement(std::span<const std::byte> bytes);

}  // namespace lightcal::devices::pce174
