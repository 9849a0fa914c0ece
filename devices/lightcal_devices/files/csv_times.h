// SPDX-License-Identifier: Apache-2.0
// The times in a table's column, read together: one stamp may tell how all are written.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightcal::devices::files {

// ISO 8601 of 2026-03-01 12:00:05, 2026/03/01 12:00, 01.03.2026 12:00, of seconds since 1970 (ten
// digits) or milliseconds (13); "" for anything else.
[[nodiscard]] std::string TimeOfCell(std::string_view cell);

// ISO 8601 of each cell ("" of an empty one). 3/1/2026 2:05:00 PM is of March or of January: of all
// as the one says that has no such month (3/25/2026), by twelve hours or 24. Absent where any cell
// is no time, or none tells.
[[nodiscard]] std::optional<std::vector<std::string>> TimesOfCells(
    const std::vector<std::string_view>& cells);

}  // namespace lightcal::devices::files
