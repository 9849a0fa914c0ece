// SPDX-License-Identifier: Apache-2.0
// Files that instruments and their apps export -> spectra and readings.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/imported_file.h"
#include "lightcal_devices/files/file_bytes.h"

namespace lightcal::devices {

// Recognises the format by content (never by extension alone) and reads it whole; a .zip that holds
// one file stands for that file. UTF-8, UTF-16 with byte order mark, ISO 8859-1; any line ends.
// Fails: not_found, unreadable. Refused: unknown_format (lists what is understood), not_text,
// bad_archive, too_large (over 256 MiB), bad_spectrum, bad_row, no_rows, units_ambiguous.
[[nodiscard]] Result<ImportedFile> ImportFile(const std::string& path);
// A table whose columns a person names (files/plain_csv.h, ReadCsvOfColumns).
[[nodiscard]] Result<ImportedFile> ImportFile(const std::string& path,
                                              const std::vector<std::string>& columns);
// The same of a file whose bytes were read already.
[[nodiscard]] Result<ImportedFile> ImportRead(const files::FileBytes& file,
                                              const std::string& path);
// The same from bytes; `name` stands in messages.
[[nodiscard]] Result<ImportedFile> ImportBytes(std::string_view bytes, std::string_view name);

}  // namespace lightcal::devices
