// SPDX-License-Identifier: Apache-2.0
// The smallest pictures there are: one colour, for formats that want an image of an even dome.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace lightcal {

// A PNG of side x side pixels (1 to 64), RGBA, eight bits, all of one colour. The pixels are
// stored, not compressed.   Source: ISO/IEC 15948; RFC 1950, 1951.
[[nodiscard]] std::string PngOfOneColor(int side, const std::array<std::uint8_t, 4>& rgba);

}  // namespace lightcal
