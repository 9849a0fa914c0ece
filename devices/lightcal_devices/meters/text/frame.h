// SPDX-License-Identifier: Apache-2.0
// A line of text as a reading. Pure: no wire, no clock.
#pragma once

#include <optional>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal::devices::text {

inline constexpr std::size_t kLongestLineBytes = 256;

struct TextReading {
  Lux illuminance{0.0};
  std::optional<Kelvin> cct;
  bool over_range = false;   // the light is at least illuminance
  bool under_range = false;  // at most
};

// "192", "192 lx", "17.8fc", "1.2klx", and with a colour temperature "192,5600", "192lx;5600K",
// "192 5600K": illuminance, then CCT from 1000 to 100000 K. A line that is blank or begins with
// '#', ';' or "//" is no reading and no error. ">20000" is light beyond the meter's range, "<0.1"
// below it.
// Fails: bad_reply, with what is wrong; a number that is negative or above a million lux too.
[[nodiscard]] Result<std::optional<TextReading>> DecodeLine(std::string_view line);

}  // namespace lightcal::devices::text
