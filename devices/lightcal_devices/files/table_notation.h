// SPDX-License-Identifier: Apache-2.0
// How the numbers of a whole table are written, told by all its cells together.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal_devices/files/csv_table.h"

namespace lightcal::devices::files {

// A sign is of decimals where any cell of numbers shows it so (192,5), of thousands where the other
// is of decimals or a cell shows both (12,030.5); where only open cells are left (8,120), a lamp
// tells that is read at more than 100 m, at less than a centimetre, or of a few kelvin otherwise.
// Between commas and blanks a lone point is of decimals. Where cells contradict each other, none
// parts thousands. What a person says stands above all of it.
// Refused: decimals_ambiguous, of an illuminance or a distance whose sign nothing tells.
[[nodiscard]] Result<NumberNotation> NotationOf(const CsvTable& table, char delimiter,
                                                DecimalSign said);

}  // namespace lightcal::devices::files
