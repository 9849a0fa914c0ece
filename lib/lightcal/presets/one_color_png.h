// SPDX-License-Identifier: Apache-2.0
// Small pictures for formats that want them inside: of an even dome, or the blurred sides of one.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace lightcal {

// A PNG of side x side pixels (1 to 64), RGBA, eight bits, row after row. The pixels are stored,
// not compressed.   Source: ISO/IEC 15948; RFC 1950, 1951.
[[nodiscard]] std::string PngOfTexels(int side, std::span<const std::array<std::uint8_t, 4>> rgba);
// The same of one colour.
[[nodiscard]] std::string PngOfOneColor(int side, const std::array<std::uint8_t, 4>& rgba);

}  // namespace lightcal
