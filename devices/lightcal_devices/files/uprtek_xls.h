// SPDX-License-Identifier: Apache-2.0
// What UPRtek's meters (CV600, MK350 ...) call .xls: tab-separated text with CRLF, one label and
// one value a row, "LUX\t695.15", then "380nm\t0.030267" in mW m^-2 nm^-1.
#pragma once

#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::devices::files {

[[nodiscard]] bool IsUprtekXls(std::string_view text);
// Refused: bad_spectrum.
[[nodiscard]] Result<ImportedFile> ReadUprtekXls(std::string_view text, std::string_view name);

}  // namespace lightcal::devices::files
