// SPDX-License-Identifier: Apache-2.0
// Whether the columns of a table say what they hold.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal_devices/files/csv_table.h"

namespace lightcal::devices::files {

// What is left out, and why (column_ignored), after the table's own. Refused: units_ambiguous (a
// quantity whose unit is not said, which is never guessed, or numbers of an unknown name).
[[nodiscard]] Result<Warnings> CheckColumns(const CsvTable& table);

// Refused: units_ambiguous, naming both columns. A table of spectra may hold many.
[[nodiscard]] Result<void> CheckNoQuantityTwice(const CsvTable& table, bool spectral);

}  // namespace lightcal::devices::files
