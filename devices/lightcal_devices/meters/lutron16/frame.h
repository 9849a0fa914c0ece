// SPDX-License-Identifier: Apache-2.0
// The 16-character frames of Lutron instruments as values. Pure: no wire, no clock.
#pragma once

#include <cstddef>
#include <span>

#include "lightcal/core/result.h"
#include "lightcal_devices/meters/display.h"

namespace lightcal::devices::lutron16 {

inline constexpr std::size_t kFrameBytes = 16;

// Whether these could be the first bytes of a frame: 02 '4', and 0D at its end.
[[nodiscard]] bool MayBeginFrame(std::span<const std::byte> bytes);

struct Measurement {
  DisplayedIlluminance shown;
  bool upper_display = true;  // the lower one shows something else than the light
  bool negative = false;
};
// Layout: README.md. The unit and number of the lower display are not looked at.
// Fails: bad_reply (another length or form, characters that are no digits); wrong_unit, with the
// code, for an instrument that does not show lux or foot-candles.
[[nodiscard]] Result<Measurement> DecodeMeasurement(std::span<const std::byte> bytes);

}  // namespace lightcal::devices::lutron16
