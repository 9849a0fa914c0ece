// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/table_notation.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"

namespace lightcal::devices::files {
namespace {

bool IsLength(CsvQuantity quantity) {
  return quantity == CsvQuantity::kDistance || quantity == CsvQuantity::kPositionX ||
         quantity == CsvQuantity::kPositionY || quantity == CsvQuantity::kPositionZ;
}

// Columns whose numbers a factor of a thousand makes another lamp's.
bool DecidesTheLamp(CsvQuantity quantity) {
  return IsLength(quantity) || quantity == CsvQuantity::kIlluminance ||
         quantity == CsvQuantity::kCard;
}

bool MayHoldNumbers(CsvQuantity quantity) {
  return !IsWord(quantity) || quantity == CsvQuantity::kState ||
         quantity == CsvQuantity::kDimmerUnsaid;
}

// A cell's number without the sign of a limit.
std::string_view NumberOf(const Row& row, std::size_t column) {
  std::string_view cell = TrimBlanks(CellAt(row, column));
  if (LimitSignOf(cell) != '\0') cell.remove_prefix(1);
  return TrimBlanks(cell);
}

// What one meaning of an open cell makes impossible.
enum class Told { kNothing, kDecimals, kThousands };
Told ToldBySize(const CsvColumn& column, std::string_view open_cell) {
  constexpr double kFarthestMetres = 100.0, kNearestMetres = 0.01;
  constexpr double kFewestKelvin = 1000.0;
  const auto [thousands, decimals] = MeaningsOf(open_cell);
  if (column.quantity == CsvQuantity::kCct && decimals < kFewestKelvin) return Told::kThousands;
  if (!IsLength(column.quantity)) return Told::kNothing;
  if (thousands * column.scale > kFarthestMetres) return Told::kDecimals;
  const bool distance = column.quantity == CsvQuantity::kDistance;
  return distance && decimals * column.scale < kNearestMetres ? Told::kThousands : Told::kNothing;
}

// What all cells of numbers show of one sign.
struct Shown {
  bool decimal = false, parts = false;
  bool decimal_by_size = false, parts_by_size = false;

  void Settle() {
    if (decimal || parts || decimal_by_size == parts_by_size) return;
    decimal = decimal_by_size;
    parts = parts_by_size;
  }
};
struct ShownSigns {
  Shown comma, point;
};

ShownSigns SignsIn(const CsvTable& table) {
  ShownSigns shown;
  for (const Row& row : table.rows) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (!MayHoldNumbers(table.columns[i].quantity)) continue;
      const std::string_view cell = NumberOf(row, i);
      const SignsOfCell signs = SignsOf(cell);
      shown.comma.decimal |= signs.comma_decimal;
      shown.comma.parts |= signs.comma_parts;
      shown.point.decimal |= signs.point_decimal;
      shown.point.parts |= signs.point_parts;
      if (signs.open == '\0') continue;
      Shown& sign = signs.open == ',' ? shown.comma : shown.point;
      const Told told = ToldBySize(table.columns[i], cell);
      sign.decimal_by_size |= told == Told::kDecimals;
      sign.parts_by_size |= told == Told::kThousands;
    }
  }
  return shown;
}

// The refusal of an open cell, by its line and column, with both its meanings.
tl::unexpected<Error> Ambiguous(const CsvTable& table, const Row& row, std::size_t column) {
  const std::string cell(NumberOf(row, column));
  const auto [thousands, decimals] = MeaningsOf(cell);
  const bool comma = cell.find(',') != std::string::npos;
  const std::string whole = ShortestText(thousands), fraction = ShortestText(decimals);
  return Refused("decimals_ambiguous", AtLine(table.name, row.line),
                 cell + " in the column " + table.columns[column].written + " is " + whole +
                     " if its " + (comma ? "comma" : "point") + " parts thousands and " + fraction +
                     " if decimals, and no other number of the file tells which: write " + whole +
                     " or " + fraction + ", or say what parts decimals: {import.decimals} (" +
                     (comma ? "point: " : "comma: ") + whole + ", " +
                     (comma ? "comma: " : "point: ") + fraction + ")");
}

Result<void> CheckNothingOpen(const CsvTable& table, bool comma_open, bool point_open) {
  for (const Row& row : table.rows) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (!DecidesTheLamp(table.columns[i].quantity)) continue;
      const char open = SignsOf(NumberOf(row, i)).open;
      if ((open == ',' && comma_open) || (open == '.' && point_open)) {
        return Ambiguous(table, row, i);
      }
    }
  }
  return {};
}

}  // namespace

Result<NumberNotation> NotationOf(const CsvTable& table, char delimiter, DecimalSign said) {
  constexpr NumberNotation kPoints{'.', ','}, kCommas{',', '.'};
  if (said == DecimalSign::kPoint) return kPoints;
  if (said == DecimalSign::kComma) return kCommas;
  auto [comma, point] = SignsIn(table);
  comma.Settle();
  point.Settle();
  const bool points = point.decimal || comma.parts, commas = comma.decimal || point.parts;
  if (points && commas) return NumberNotation{delimiter == ',' ? '.' : ',', '\0'};
  if (points) return kPoints;
  if (commas) return kCommas;
  // Nothing tells: in columns where a thousand is no matter a lone sign is of decimals.
  const bool lone_point = delimiter == ',' || delimiter == ' ';
  if (auto told = CheckNothingOpen(table, true, !lone_point); !told) {
    return Propagate(std::move(told));
  }
  const bool any_comma = std::ranges::any_of(table.rows, [&](const Row& row) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (MayHoldNumbers(table.columns[i].quantity) && SignsOf(NumberOf(row, i)).open == ',') {
        return true;
      }
    }
    return false;
  });
  return NumberNotation{any_comma && delimiter != ',' ? ',' : '.', '\0'};
}

}  // namespace lightcal::devices::files
