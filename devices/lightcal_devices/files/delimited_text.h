// SPDX-License-Identifier: Apache-2.0
// Exported text files as UTF-8 rows of cells. libcsv does the splitting (RFC 4180 quotes).
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal::devices::files {

// The file as UTF-8 with \n line ends. UTF-16 is recognised by its byte order mark; bytes that are
// not UTF-8 are read as ISO 8859-1, as meter software of Western Europe writes it.
// Refused: not_text (NUL bytes).
[[nodiscard]] Result<std::string> TextFromBytes(std::string_view bytes, std::string_view name);

// What stands between the cells of a header: a tab, else a ';', else a comma.
[[nodiscard]] char DelimiterOf(std::string_view header);

struct Row {
  int line = 0;  // 1-based line of the file
  std::vector<std::string> cells;
};

// Hands every row to `visit`, in order, blanks around unquoted cells removed; an empty line is a
// row without cells. Stops at the first refusal and returns it.
using RowVisitor = std::function<Result<void>(int line, std::span<const std::string> cells)>;
[[nodiscard]] Result<void> ForEachRow(std::string_view text, char delimiter,
                                      const RowVisitor& visit);
[[nodiscard]] Result<std::vector<Row>> ReadRows(std::string_view text, char delimiter);

// The cell, or "" where the row is shorter.
[[nodiscard]] std::string_view CellAt(const Row& row, std::size_t column);

// Between tabs or semicolons a number such as 0,5 has a decimal comma: whether one stands in a
// column that may hold numbers.
[[nodiscard]] bool HasDecimalComma(std::span<const Row> rows, char delimiter,
                                   const std::function<bool(std::size_t column)>& may_hold);

// Whether any line of the text begins so.
[[nodiscard]] bool HasLineStarting(std::string_view text, std::string_view prefix);

// One unit of the last digit a number is printed with: "1,34E+00" -> 0.01, "3262" -> 1.
[[nodiscard]] double LastDigit(std::string_view printed);

// ISO 8601 from the whole numbers of a date and time in the order year month day hour minute second
// (or day month year ...), whatever separates them, with the fraction of the second and the zone
// ("Z", "+02:00", "-0500") where they follow; "" where it is no valid date.
enum class DateOrder { kYearFirst, kDayFirst };
[[nodiscard]] std::string IsoTime(std::string_view text, DateOrder order);

// "file.csv:12"
[[nodiscard]] std::string AtLine(std::string_view name, int line);

}  // namespace lightcal::devices::files
