// SPDX-License-Identifier: Apache-2.0
// Texts of Industrial I/O attributes as values. Pure: no files, no clock.
#pragma once

#include <optional>
#include <string_view>

#include "lightcal/core/result.h"

namespace lightcal::devices::iio {

inline constexpr std::string_view kBadReply = "bad_reply";

// One number as sysfs prints it, and the step of its last digit.
struct Number {
  double value = 0.0;
  double step = 1.0;  // 1 of "209", 1e-6 of "0.010000"
};
// "209\n" -> 209. Fails: bad_reply (anything but one finite decimal number of at most 1e15).
[[nodiscard]] Result<Number> DecodeNumber(std::string_view text, std::string_view attribute);

// A channel: `input` is in units already; else (raw + offset) scale, as the kernel's ABI says.
// Source: Documentation/ABI/testing/sysfs-bus-iio of Linux.
struct Channel {
  std::optional<Number> input;
  std::optional<Number> raw;
  std::optional<Number> offset;  // absent = 0
  std::optional<Number> scale;   // absent = 1
};
// Absent when the channel has neither input nor raw. `step` is what one count changes.
[[nodiscard]] std::optional<Number> ValueOf(const Channel& channel);

}  // namespace lightcal::devices::iio
