// SPDX-License-Identifier: Apache-2.0
// Log of Condor Instruments' ActLumus light logger: 32 header lines, then ';' separated rows whose
// column LIGHT is photopic illuminance in lx and DATE/TIME is dd/mm/yyyy hh:mm:ss, local time.
#pragma once

#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::devices::files {

[[nodiscard]] bool IsActlumusLog(std::string_view text);
// A row without a time or a finite illuminance >= 0 is left out with one warning bad_row that
// counts them. Refused: no_rows.
[[nodiscard]] Result<ImportedFile> ReadActlumusLog(std::string_view text, std::string_view name);

}  // namespace lightcal::devices::files
