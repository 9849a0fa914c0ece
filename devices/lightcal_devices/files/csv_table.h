// SPDX-License-Identifier: Apache-2.0
// Rows of text under columns whose meaning is known: by the table's own header, or because a person
// named them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/files/csv_columns.h"
#include "lightcal_devices/files/delimited_text.h"
#include "lightcal_devices/files/import_file.h"
#include "lightcal_devices/files/number_notation.h"

namespace lightcal::devices::files {

struct CsvTable {
  std::string name;
  std::vector<CsvColumn> columns;
  std::vector<Row> rows;
  NumberNotation notation{};
  Warnings warnings{};  // rows_skipped
};

// Whether a column holds words, whether nothing is wanted of it.
[[nodiscard]] bool IsWord(CsvQuantity quantity);
[[nodiscard]] bool IsLeftOut(CsvQuantity quantity);

// Absent where the cell is no finite number; in a column of illuminance, of a limit its number.
[[nodiscard]] std::optional<double> NumberAt(const CsvTable& table, const Row& row,
                                             std::size_t column);

// The refusal of such a cell, by its line and column, with what to write instead.
[[nodiscard]] tl::unexpected<Error> NotANumber(const CsvTable& table, const Row& row,
                                               std::size_t column, std::string_view code);

// Whether the first line that is no comment names at least one quantity.
[[nodiscard]] bool IsTableUnderHeader(std::string_view text);

// Of the columns that come out, none is kTimestamp, kDimmerUnsaid or kFixture; a date stands with
// its time, and a column lamp that holds no on or off is the light's name, or the one of fixtures.
// Refused: no_rows, bad_row (more cells than columns, naming the line), units_ambiguous (a dimmer
// that may be parts of 1), decimals_ambiguous (table_notation.h).
[[nodiscard]] Result<CsvTable> TableUnderHeader(std::string_view text, std::string_view name,
                                                DecimalSign decimals);

// What stands above the first row of numbers is a title; "-" leaves a column out. A title that
// holds a number in a column of numbers is named (rows_skipped). Refused: no_rows, unknown_column
// (a name not understood, or more cells in a row than names), bad_row (above the first row of
// numbers, one that begins with a number and goes on with something else), decimals_ambiguous.
[[nodiscard]] Result<CsvTable> TableOfColumns(std::string_view text, std::string_view name,
                                              const TableWords& words);

}  // namespace lightcal::devices::files
