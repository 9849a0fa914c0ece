// SPDX-License-Identifier: Apache-2.0
// The library's sources, answered from disk.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/records/sources.h"

namespace lightcal::devices {

// Each file is opened once in the life of these sources and their copies, whatever is asked about
// it: texts and tables are held, EXR and camera RAW stay mapped (OpenImageIO opens TIFF, PNG, JPEG
// and Radiance HDR itself once more). They may be asked from several threads at once.
[[nodiscard]] Sources DiskSources();

// SHA-256 of bytes, lower-case hex.
[[nodiscard]] std::string Sha256Hex(std::string_view bytes);

}  // namespace lightcal::devices
