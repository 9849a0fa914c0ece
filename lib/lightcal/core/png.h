// SPDX-License-Identifier: Apache-2.0
// The frame of a PNG file; whoever writes one packs its rows himself.   Source: ISO/IEC 15948:2004.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lightcal {

// The four bytes of a number as PNG and zlib hold it.
[[nodiscard]] std::string BigEndian(std::uint32_t value);

// Length, type, data, check sum (5.3).
[[nodiscard]] std::string PngChunk(std::string_view type, std::string_view data);

enum class PngColor : char { kRgb = 2, kRgba = 6 };

// A whole file of eight bits a sample. `packed`: the rows, each behind its filter type, as a zlib
// stream.
[[nodiscard]] std::string PngFile(int width, int height, PngColor color, std::string_view packed);

}  // namespace lightcal
