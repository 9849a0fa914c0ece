// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "lightcal/core/result.h"

namespace lightcal::devices::files {

// No export of a meter is larger; keeps a crafted archive from filling the memory.
inline constexpr std::size_t kMaxFileBytes = std::size_t{256} << 20;

[[nodiscard]] bool IsZip(std::string_view bytes);
// The one file in a .zip; the resource forks macOS adds (__MACOSX/, ._name) do not count.
// Refused: bad_archive (damaged, encrypted, no file or several), too_large. Here and below, fails:
// no_archive_module (the program is badly installed): libarchive stands in a module, opened at the
// first call.
[[nodiscard]] Result<std::string> OnlyFileInZip(std::string_view bytes, std::string_view name);
// The file of that path in a .zip, of at most so many bytes when unpacked; the others are not
// unpacked. Refused: bad_archive (damaged, encrypted, without it, over 10,000 files), too_large.
[[nodiscard]] Result<std::string> FileInZip(std::string_view bytes, std::string_view path,
                                            std::size_t most, std::string_view name);

}  // namespace lightcal::devices::files
