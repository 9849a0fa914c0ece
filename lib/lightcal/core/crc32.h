// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace lightcal {

// The check sum of PNG chunks and zip entries: polynomial 0xEDB88320, reflected, inverted.
// Source: ISO/IEC 15948:2004, annex D.
[[nodiscard]] std::uint32_t Crc32(std::string_view bytes);

}  // namespace lightcal
