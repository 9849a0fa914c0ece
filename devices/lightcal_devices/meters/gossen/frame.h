// SPDX-License-Identifier: Apache-2.0
// Lines of the Gossen MAVOLUX 5032 B/C USB as values. Pure: no wire, no clock.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/meters/display.h"

namespace lightcal::devices::gossen {

inline constexpr std::size_t kLongestReplyBytes = 128;

// "ERROR = 19" -> 19; absent where the line is none.
[[nodiscard]] std::optional<int> DecodeError(std::string_view line);
// What an error number means and what to do, as an Error. Its code:
//   serial_error    1 to 4, 8: bytes were damaged on the line; asking again may help
//   over_range      19, 203
//   wrong_head      202: a sensor the unit does not belong to
//   hardware_error  17, 18, 21, 22, 201
//   refused_command any other
[[nodiscard]] Error ErrorOf(int number, const std::string& device);

// "[*IDN ]GOSSEN,M 502, 20387,01,V 1.00": maker, type, serial, hardware, firmware.
struct Identity {
  std::string type;
  std::string serial;
  std::string firmware;
};
// Fails: bad_reply.
[[nodiscard]] Result<Identity> DecodeIdentity(std::string_view line);

// "[echo ]nnnnn E-xy uu", blanks around E as they come: "1234E-01 LX" is 123.4 lx,
// "MEASURE:PHOTO? 123E00 LX" 123 lx.
// Fails: bad_reply; luminance_head where the unit is cd/m^2 or foot-lambert.
[[nodiscard]] Result<DisplayedIlluminance> DecodeMeasurement(std::string_view line);

}  // namespace lightcal::devices::gossen
