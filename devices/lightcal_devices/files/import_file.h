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

// What a person says of a table that its own header or numbers do not.
enum class DecimalSign { kUnsaid, kPoint, kComma };
struct TableWords {
  std::vector<std::string> columns;  // what they are, in their order; none = as the header says
  DecimalSign decimals = DecimalSign::kUnsaid;
};

// Recognises the format by content (never by extension alone) and reads it whole; a .zip that holds
// one file stands for that file. UTF-8, UTF-16 with byte order mark, ISO 8859-1; any line ends.
// Fails: not_found, unreadable. Refused: unknown_format (lists what is understood), not_text,
// bad_archive, too_large (over 256 MiB), bad_spectrum, bad_row, no_rows, units_ambiguous,
// decimals_ambiguous.
[[nodiscard]] Result<ImportedFile> ImportFile(const std::string& path);
// A table of which a person says something (files/plain_csv.h). Refused besides: unknown_format of
// a file whose format says its decimals itself.
[[nodiscard]] Result<ImportedFile> ImportFile(const std::string& path, const TableWords& words);
// The same of a file whose bytes were read already.
[[nodiscard]] Result<ImportedFile> ImportRead(const files::FileBytes& file,
                                              const std::string& path);
// The same from bytes; `name` stands in messages.
[[nodiscard]] Result<ImportedFile> ImportBytes(std::string_view bytes, std::string_view name);

}  // namespace lightcal::devices
