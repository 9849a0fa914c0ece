// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/csv_table.h"

#include <algorithm>
#include <iterator>
#include <ranges>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal_devices/files/csv_times.h"
#include "lightcal_devices/files/table_notation.h"

namespace lightcal::devices::files {
namespace {

bool IsCommentOrEmpty(const Row& row) {
  const bool empty = std::ranges::all_of(
      row.cells, [](const std::string& cell) { return TrimBlanks(cell).empty(); });
  return empty || row.cells.front().starts_with('#');
}

// The first line that is neither empty nor a comment.
std::string_view HeaderLine(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    const std::string_view content = TrimBlanks(line);
    if (!content.empty() && !content.starts_with('#')) return line;
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return {};
}

// Runs of blanks become one tab, so that columns between blanks read as any others.
std::string TabsForBlanks(std::string_view text) {
  std::string tabbed;
  bool blank = true;  // a row may begin with blanks
  for (const char c : text) {
    if (c == ' ' || c == '\t') {
      blank = true;
      continue;
    }
    const bool line_end = c == '\n' || c == '\r';
    if (blank && !line_end && !tabbed.empty() && tabbed.back() != '\n') tabbed += '\t';
    blank = false;
    tabbed += c;
  }
  return tabbed;
}

// A row with more cells than there are columns; null where none has.
const Row* RowTooWide(const CsvTable& table) {
  const auto row = std::ranges::find_if(
      table.rows, [&](const Row& one) { return one.cells.size() > table.columns.size(); });
  return row == table.rows.end() ? nullptr : &*row;
}

Result<std::vector<CsvColumn>> ColumnsNamed(const std::vector<std::string>& names) {
  std::vector<CsvColumn> columns;
  for (const std::string& name : names) {
    CsvColumn column =
        name == "-" ? CsvColumn{CsvQuantity::kLeftOut, 1.0, name, ""} : ColumnFromName(name);
    if (column.quantity == CsvQuantity::kUnknown || column.quantity == CsvQuantity::kNeedsUnit) {
      const std::string nearest = NearestColumnName(name);
      return Refused(
          "unknown_column", "'" + name + "'",
          std::string(column.quantity == CsvQuantity::kNeedsUnit ? "has no unit" : "is not known") +
              (nearest.empty() ? "." : "; did you mean " + nearest + "?") + " Understood are " +
              KnownColumnNames() + ", and - for one to leave out");
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

// Whether every column that holds numbers has one here (or nothing), and one at least.
bool IsRowOfNumbers(const CsvTable& table, const Row& row) {
  bool any = false;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvQuantity quantity = table.columns[i].quantity;
    if (IsWord(quantity) || quantity == CsvQuantity::kLeftOut) continue;
    if (TrimBlanks(CellAt(row, i)).empty()) continue;
    if (!NumberAt(table, row, i)) return false;
    any = true;
  }
  return any;
}

bool HoldsNumbers(const CsvColumn& column) {
  return !IsWord(column.quantity) && !IsLeftOut(column.quantity);
}

// The cell that makes a row with a number in its first column of numbers none of numbers.
std::string_view CellThatIsNone(const CsvTable& table, const Row& row) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (!HoldsNumbers(table.columns[i]) || TrimBlanks(CellAt(row, i)).empty()) continue;
    if (!NumberAt(table, row, i)) return CellAt(row, i);
  }
  return {};
}

// Drops the titles above the first row of numbers; a row of data with a slip in it is none.
Result<void> DropTitles(CsvTable& table) {
  const auto first =
      std::ranges::find_if(table.rows, [&](const Row& row) { return IsRowOfNumbers(table, row); });
  if (first == table.rows.end()) {
    return Refused("no_rows", table.name, "has no row of numbers in the columns named");
  }
  const auto column = static_cast<std::size_t>(std::ranges::find_if(table.columns, HoldsNumbers) -
                                               table.columns.begin());
  std::string skipped;
  for (auto row = table.rows.begin(); row != first; ++row) {
    if (NumberAt(table, *row, column)) {
      return Refused("bad_row", AtLine(table.name, row->line),
                     "begins with a number and goes on with '" +
                         std::string(CellThatIsNone(table, *row).substr(0, 40)) +
                         "', which is none: correct the cell, or put # before a line that is no "
                         "reading");
    }
    bool any = false;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      any = any || (HoldsNumbers(table.columns[i]) && NumberAt(table, *row, i));
    }
    if (any) skipped += (skipped.empty() ? "" : ", ") + std::to_string(row->line);
  }
  if (!skipped.empty()) {
    table.warnings.push_back({"rows_skipped", table.name + ", line " + skipped,
                              "taken for a title: its first column holds no number"});
  }
  table.rows.erase(table.rows.begin(), first);
  return {};
}

Result<void> TellNotation(CsvTable& table, char delimiter, DecimalSign said) {
  const auto notation = NotationOf(table, delimiter, said);
  if (!notation) return tl::unexpected(notation.error());
  table.notation = *notation;
  return {};
}

// A fraction, and nothing above 1 or in percent by its own sign.
template <class Cells>
bool MayBePartsOfOne(Cells&& cells, const NumberNotation& notation) {
  double most = 0.0;
  for (const std::string_view cell : cells) {
    const auto number = NumberIn(cell, notation);
    if (!number || *number > 1.0) return false;
    most = std::max(most, *number);
  }
  return most > 0.0;
}

std::size_t ColumnOf(const CsvTable& table, CsvQuantity quantity) {
  return static_cast<std::size_t>(std::ranges::find(table.columns, quantity, &CsvColumn::quantity) -
                                  table.columns.begin());
}

// Puts a date in a column of its own before the time beside it, and writes all times as ISO 8601
// where the column tells how they are meant. A timestamp that is none is a column of words.
void SettleTimes(CsvTable& table) {
  std::size_t time = ColumnOf(table, CsvQuantity::kTime);
  const bool named_time = time < table.columns.size();
  if (!named_time) time = ColumnOf(table, CsvQuantity::kTimestamp);
  const std::size_t date = ColumnOf(table, CsvQuantity::kDate);
  const bool dated = date < table.columns.size() && time < table.columns.size();
  if (date < table.columns.size() && !dated) table.columns[date].quantity = CsvQuantity::kUnknown;
  std::vector<std::string> written;
  for (const Row& row : table.rows) {
    const std::string cell(TrimBlanks(CellAt(row, time)));
    written.push_back(
        dated && !cell.empty() ? std::string(TrimBlanks(CellAt(row, date))) + " " + cell : cell);
  }
  const auto times = TimesOfCells({written.begin(), written.end()});
  for (std::size_t i = 0; times && i < table.rows.size(); ++i) {
    if (time < table.rows[i].cells.size()) table.rows[i].cells[time] = (*times)[i];
  }
  for (CsvColumn& column : table.columns) {
    const bool other = &column != table.columns.data() + time;
    if (column.quantity == CsvQuantity::kTimestamp) {
      column.quantity = times && !other ? CsvQuantity::kTime : CsvQuantity::kUnknown;
    }
    // Which day and which month nobody can tell: a column of words, as it stands.
    const bool of_date = column.quantity == CsvQuantity::kDate || (dated && !other);
    if (of_date && !times) column.quantity = CsvQuantity::kUnknown;
  }
}

// A column named lamp is its name where none of its cells says on or off.
void SettleLamp(CsvTable& table) {
  const std::size_t lamp = ColumnOf(table, CsvQuantity::kLamp);
  const bool named = ColumnOf(table, CsvQuantity::kLight) < table.columns.size();
  if (lamp == table.columns.size() || named) return;
  constexpr std::array<std::string_view, 6> kStates = {"on", "off", "true", "false", "1", "0"};
  const bool states = std::ranges::any_of(table.rows, [&](const Row& row) {
    const std::string cell = LowerAscii(TrimBlanks(CellAt(row, lamp)));
    return std::ranges::find(kStates, cell) != kStates.end();
  });
  if (!states) table.columns[lamp].quantity = CsvQuantity::kLight;
}

// A column of fixtures names the lights where no other does; beside another it is what they are,
// and nothing of a reading.
void SettleFixtures(CsvTable& table) {
  const bool named = ColumnOf(table, CsvQuantity::kLight) < table.columns.size();
  for (CsvColumn& column : table.columns) {
    if (column.quantity != CsvQuantity::kFixture) continue;
    column.quantity = named ? CsvQuantity::kUnknown : CsvQuantity::kLight;
  }
}

// A column named timestamp is the reading's time where every cell tells one and no other column
// does; one named dimmer is in percent unless it may be parts of 1.
Result<void> SettleByCells(CsvTable& table) {
  const auto cells = [&](std::size_t column) {
    return table.rows | std::views::transform([column](const Row& row) {
             return TrimBlanks(CellAt(row, column));
           }) |
           std::views::filter([](std::string_view cell) { return !cell.empty(); });
  };
  SettleTimes(table);
  SettleLamp(table);
  SettleFixtures(table);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    CsvColumn& column = table.columns[i];
    if (column.quantity != CsvQuantity::kDimmerUnsaid) continue;
    column.quantity = CsvQuantity::kState;
    if (MayBePartsOfOne(cells(i), table.notation)) {
      return Refused("units_ambiguous", table.name + ", column " + column.written,
                     "holds no value above 1: are they parts of 1, or percent? Write percent, and "
                     "name it state.dimmer");
    }
  }
  return {};
}

}  // namespace

bool IsWord(CsvQuantity quantity) {
  return quantity == CsvQuantity::kLight || quantity == CsvQuantity::kMeter ||
         quantity == CsvQuantity::kTime || quantity == CsvQuantity::kLamp ||
         quantity == CsvQuantity::kShadowCard || quantity == CsvQuantity::kState ||
         quantity == CsvQuantity::kTimestamp || quantity == CsvQuantity::kDimmerUnsaid ||
         quantity == CsvQuantity::kDate || quantity == CsvQuantity::kFixture;
}

bool IsLeftOut(CsvQuantity quantity) {
  return quantity == CsvQuantity::kUnknown || quantity == CsvQuantity::kLeftOut;
}

std::optional<double> NumberAt(const CsvTable& table, const Row& row, std::size_t column) {
  std::string_view cell = TrimBlanks(CellAt(row, column));
  const bool limit = column < table.columns.size() &&
                     table.columns[column].quantity == CsvQuantity::kIlluminance &&
                     LimitSignOf(cell) != '\0';
  if (limit) cell.remove_prefix(1);
  return NumberIn(cell, table.notation);
}

tl::unexpected<Error> NotANumber(const CsvTable& table, const Row& row, std::size_t column,
                                 std::string_view code) {
  const bool commas = table.notation.decimal == ',';
  const std::string_view cell = CellAt(row, column);
  // A number by the other sign: 400.5 among decimal commas.
  const bool by_other = NumberIn(cell, {commas ? '.' : ',', '\0'}).has_value();
  std::string typed(TrimBlanks(cell));
  std::ranges::replace(typed, commas ? '.' : ',', commas ? ',' : '.');
  return Refused(
      std::string(code), AtLine(table.name, row.line),
      "'" + std::string(cell.substr(0, 40)) + "' in the column " + table.columns[column].written +
          " is no finite number" + (IsOverloadWord(cell) ? "; " + std::string(kWriteALimit) : "") +
          (by_other
               ? std::string("; the decimals of this file are ") + (commas ? "commas" : "points") +
                     ": write " + typed + ", or thousands without a sign"
               : ""));
}

bool IsTableUnderHeader(std::string_view text) {
  const std::string_view header = HeaderLine(text);
  const auto rows = ReadRows(header, DelimiterOf(header));
  if (!rows || rows->empty()) return false;
  return std::ranges::any_of(rows->front().cells, [](const std::string& name) {
    return ColumnFromName(name).quantity != CsvQuantity::kUnknown;
  });
}

Result<CsvTable> TableUnderHeader(std::string_view text, std::string_view name,
                                  DecimalSign decimals) {
  const char delimiter = DelimiterOf(HeaderLine(text));
  auto rows = ReadRows(text, delimiter);
  if (!rows) return Propagate(std::move(rows));
  std::erase_if(*rows, IsCommentOrEmpty);
  CsvTable table;
  table.name = name;
  // A quote left open in a comment swallows the header too.
  if (rows->empty()) return Refused("no_rows", table.name, "holds comments only");
  for (const std::string& written : rows->front().cells) {
    table.columns.push_back(ColumnFromName(written));
  }
  table.rows.assign(std::make_move_iterator(rows->begin() + 1),
                    std::make_move_iterator(rows->end()));
  if (table.rows.empty()) {
    return Refused("no_rows", table.name, "has a header and no row under it");
  }
  if (const Row* const wide = RowTooWide(table)) {
    return Refused("bad_row", AtLine(table.name, wide->line),
                   "has " + std::to_string(wide->cells.size()) + " cells, the header has " +
                       std::to_string(table.columns.size()) +
                       "; numbers with a decimal comma need ';' between the columns");
  }
  if (auto told = TellNotation(table, delimiter, decimals); !told)
    return Propagate(std::move(told));
  if (auto settled = SettleByCells(table); !settled) return Propagate(std::move(settled));
  return table;
}

Result<CsvTable> TableOfColumns(std::string_view text, std::string_view name,
                                const TableWords& words) {
  CsvTable table;
  table.name = name;
  auto columns = ColumnsNamed(words.columns);
  if (!columns) return Propagate(std::move(columns));
  table.columns = *std::move(columns);
  // What parts the cells is read off the last line, as titles above may hold any character. Blanks
  // do where nothing else does, or where they alone give the columns named (0,5 192).
  std::string_view last = TrimBlanks(text);
  if (const auto end = last.rfind('\n'); end != std::string_view::npos) last.remove_prefix(end + 1);
  const std::string last_tabbed = TabsForBlanks(last);
  const auto tabs = static_cast<std::size_t>(std::ranges::count(last_tabbed, '\t'));
  const bool blanks =
      last.find_first_of(";\t") == std::string_view::npos &&
      (last.find(',') == std::string_view::npos || (tabs > 0 && tabs + 1 == table.columns.size()));
  const std::string tabbed = blanks ? TabsForBlanks(text) : std::string(text);
  const char delimiter = blanks ? '\t' : DelimiterOf(last);
  auto rows = ReadRows(tabbed, delimiter);
  if (!rows) return Propagate(std::move(rows));
  std::erase_if(*rows, IsCommentOrEmpty);
  table.rows = *std::move(rows);
  if (auto told = TellNotation(table, blanks ? ' ' : delimiter, words.decimals); !told) {
    return Propagate(std::move(told));
  }
  if (auto dropped = DropTitles(table); !dropped) return Propagate(std::move(dropped));
  if (auto settled = SettleByCells(table); !settled) return Propagate(std::move(settled));
  if (const Row* const wide = RowTooWide(table)) {
    return Refused("unknown_column", AtLine(table.name, wide->line),
                   "has " + std::to_string(wide->cells.size()) + " cells, and " +
                       std::to_string(table.columns.size()) +
                       " columns are named; write - for each that is to be left out");
  }
  return table;
}

}  // namespace lightcal::devices::files
