// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace lightcal::app {

// The moment SOURCE_DATE_EPOCH names, in UTC as "2026-11-21T10:00:00Z"; absent when it is not set
// or not a whole number of seconds.
[[nodiscard]] std::optional<std::string> SourceDateIso8601();

// Now in the same form; SOURCE_DATE_EPOCH stands in for now, so that the same inputs give the same
// bytes.
[[nodiscard]] std::string NowIso8601();

// The same to the millisecond, "2026-11-21T10:00:00.123Z": a script may type two readings a second.
[[nodiscard]] std::string MomentIso8601();

}  // namespace lightcal::app
