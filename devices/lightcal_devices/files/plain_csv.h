// SPDX-License-Identifier: Apache-2.0
// CSV with a header whose column names carry units: either one reading a row (distance_m,
// illuminance_lx, ...; the meter's place as position_x_m, position_y_m, position_z_m) or one
// spectral sample a row (wavelength_nm, irradiance_W_m2_nm, ...). Separator ',' ';' or tab; what
// parts decimals and thousands its numbers tell (table_notation.h). '#' begins a comment. An
// illuminance ">400" is light beyond the meter's range (over_range), "<40" below it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::devices::files {

// Whether the first line names at least one quantity.
[[nodiscard]] bool IsPlainCsv(std::string_view text);

// One reading a row, two where card_lx gives what its place showed behind a shadow card. All rows
// or none, but those without a value (rows_skipped, said once). Refused: units_ambiguous (a
// quantity without a unit, an unknown column of numbers, the same quantity twice), bad_row (naming
// the line), no_rows, bad_spectrum, decimals_ambiguous. A column of words that no one knows is left
// out with the warning column_ignored.
[[nodiscard]] Result<ImportedFile> ReadPlainCsv(std::string_view text, std::string_view name);
// The same where a person says what parts decimals.
[[nodiscard]] Result<ImportedFile> ReadCsvUnderHeader(std::string_view text, std::string_view name,
                                                      DecimalSign decimals);

// The same of a table whose columns a person names, in their order ("-" leaves one out): of a file
// whose own header says nothing ("h,epsilon"), of one without a header, or of columns between
// blanks (.dat, .prn). What stands above the first row of numbers is a title. Refused besides:
// unknown_column (a name not understood, or more cells in a row than names), bad_row (above the
// first row of numbers, one that begins with a number). Warns besides: rows_skipped.
[[nodiscard]] Result<ImportedFile> ReadCsvOfColumns(std::string_view text, std::string_view name,
                                                    const TableWords& words);

// The column names understood, for messages.
[[nodiscard]] std::string PlainCsvColumns();

}  // namespace lightcal::devices::files
