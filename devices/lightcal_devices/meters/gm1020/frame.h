// SPDX-License-Identifier: Apache-2.0
// Bytes of the Benetech GM1020 as values. Pure: no wire, no clock.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "lightcal/core/result.h"
#include "lightcal_devices/meters/display.h"

namespace lightcal::devices::gm1020 {

inline constexpr std::size_t kFrameBytes = 8;
using Command = std::array<std::byte, kFrameBytes>;

// code, argument, five zeros, and the sum of the seven modulo 256.
[[nodiscard]] constexpr Command EncodeCommand(unsigned code, unsigned argument) {
  Command command{};
  command[0] = static_cast<std::byte>(code);
  command[1] = static_cast<std::byte>(argument);
  command.back() = static_cast<std::byte>(code + argument);
  return command;
}
inline constexpr Command kStartLive = EncodeCommand(0x3C, 1);  // from now on two a second
inline constexpr Command kStopLive = EncodeCommand(0x3C, 2);

// Whether these could be the first bytes of a live frame.
[[nodiscard]] bool MayBeginFrame(std::span<const std::byte> bytes);

// 33 22 Lhi Llo 01 Thi Tlo 11. The end mark is fixed, so that damage within L and T goes unnoticed.
struct LiveMeasurement {
  DisplayedIlluminance shown;  // always lx, whatever the display's unit
  double temperature_C = 0.0;  // of the meter
};
// r = L:  E = (r & FFF)/10, ten times that with 4000 set, a hundred times with 8000 set.
// Fails: bad_reply (another length or form, bits 1000 or 2000, which nobody has seen).
[[nodiscard]] Result<LiveMeasurement> DecodeLive(std::span<const std::byte> bytes);

}  // namespace lightcal::devices::gm1020
