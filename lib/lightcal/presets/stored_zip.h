// SPDX-License-Identifier: Apache-2.0
// A zip archive of files that are not compressed, as GDTF wants them.
#pragma once

#include <span>
#include <string>

#include "lightcal/presets/preset.h"

namespace lightcal {

// Method 0, no time (1 January 1980): the same files, the same bytes. Names and contents below
// 4 GiB.   Source: PKWARE APPNOTE 6.3.10, 4.3.7, 4.3.12, 4.3.16.
[[nodiscard]] std::string StoredZip(std::span<const PresetFile> files);

}  // namespace lightcal
