// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/csv_checks.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/csv_columns.h"

namespace lightcal::devices::files {
namespace {

// What a column's name would be if it held a control: state.mode.
std::string OfAControl(std::string_view written) {
  std::string name = "state.";
  for (const char c : TrimBlanks(written)) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    name += letter ? c : '_';
  }
  const std::string lower = LowerAscii(name);
  const bool dimmer = std::ranges::any_of(std::array{"dim", "level", "bright"}, [&](auto word) {
    return lower.find(word) != std::string::npos;
  });
  if (dimmer) return " (to state.dimmer, 0 to 100, if it is what the lamp was dimmed to)";
  return " (to " + name + " if it is a control of the lamp)";
}

}  // namespace

Result<Warnings> CheckColumns(const CsvTable& table) {
  Warnings warnings = table.warnings;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvColumn& column = table.columns[i];
    if (column.quantity == CsvQuantity::kNeedsUnit) {
      return Refused("units_ambiguous", table.name + ", column " + column.written,
                     "has no unit; put it into the name, or say what every column is: "
                     "{import.columns}. Understood are " +
                         KnownColumnNames());
    }
    if (column.quantity == CsvQuantity::kLeftOut && column.written != "-") {
      warnings.push_back({"column_ignored", table.name + ", column " + column.written,
                          "says how sure the spectrum beside it is; it is left out"});
    }
    if (column.quantity != CsvQuantity::kUnknown) continue;
    const bool numbers = std::ranges::any_of(
        table.rows, [&](const Row& row) { return NumberAt(table, row, i).has_value(); });
    if (numbers) {
      const std::string nearest = NearestColumnName(column.written);
      return Refused("units_ambiguous", table.name + ", column " + column.written,
                     "is not known" + (nearest.empty() ? "." : "; did you mean " + nearest + "?") +
                         " Rename it" + OfAControl(column.written) +
                         ", or say what every column is: {import.columns}. Understood are " +
                         KnownColumnNames());
    }
    if (!TrimBlanks(column.written).empty()) {
      warnings.push_back({"column_ignored", table.name + ", column " + column.written,
                          "holds words that no quantity is known for; it is left out. Rename it" +
                              OfAControl(column.written) +
                              " or the reading's time (time, each 2026-11-21T14:03:00)"});
    }
  }
  return warnings;
}

Result<void> CheckNoQuantityTwice(const CsvTable& table, bool spectral) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvQuantity quantity = table.columns[i].quantity;
    const bool series = quantity == CsvQuantity::kIrradiance || quantity == CsvQuantity::kRelative;
    if (IsLeftOut(quantity) || (series && spectral)) continue;
    for (std::size_t j = 0; j < i; ++j) {
      const bool other_control =
          quantity == CsvQuantity::kState && table.columns[j].series != table.columns[i].series;
      if (table.columns[j].quantity != quantity || other_control) continue;
      return Refused("units_ambiguous", table.name,
                     "the columns " + table.columns[j].written + " and " +
                         table.columns[i].written + " both give the same quantity; keep one");
    }
  }
  return {};
}

}  // namespace lightcal::devices::files
