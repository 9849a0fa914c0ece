// SPDX-License-Identifier: Apache-2.0
// When a reading was taken, as ISO 8601 writes it.
#pragma once

#include <optional>
#include <string_view>

namespace lightcal {

// Seconds of "2026-11-21T10:00:00Z" since 1970: seconds or their fraction may be left out, a blank
// stand for the T and an offset (+01:00, +0100, +01) or nothing, which counts as Z, for the Z.
// Absent: anything else.
[[nodiscard]] std::optional<double> SecondsOfTime(std::string_view iso8601);

// Whether it is such a time, or the date alone.
[[nodiscard]] bool IsTime(std::string_view iso8601);

}  // namespace lightcal
