// SPDX-License-Identifier: Apache-2.0
// The door to libarchive: what the module lightcal_archive.so answers. Both sides are built
// together.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "lightcal/core/result.h"

namespace lightcal::devices::files {

// As the functions of archive.h whose names they bear, in the module.
[[nodiscard]] Result<std::string> ReadOnlyFileInZip(std::string_view bytes, std::string_view name);
[[nodiscard]] Result<std::string> ReadFileInZip(std::string_view bytes, std::string_view path,
                                                std::size_t most, std::string_view name);

struct ArchiveFunctions {
  Result<std::string> (*only_file)(std::string_view bytes, std::string_view name);
  Result<std::string> (*file)(std::string_view bytes, std::string_view path, std::size_t most,
                              std::string_view name);
};
inline constexpr const char* kArchiveEntrySymbol = "lightcal_archive_functions";

}  // namespace lightcal::devices::files
