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
// Refused: bad_archive (damaged, encrypted, no file or several), too_large.
[[nodiscard]] Result<std::string> OnlyFileInZip(std::string_view bytes, std::string_view name);

}  // namespace lightcal::devices::files
