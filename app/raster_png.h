// SPDX-License-Identifier: Apache-2.0
// Pixels as a PNG file.
#pragma once

#include <cstdint>
#include <string>

#include "lightcal/core/view2d.h"

namespace lightcal::app {

// 8 bit RGB, rows of width x 3 samples, sRGB-encoded. Same pixels, same bytes.
// Source: ISO/IEC 15948:2004.
[[nodiscard]] std::string EncodePng(View2d<const std::uint8_t> rgb);

// The same file as a data: URI.
[[nodiscard]] std::string PngUri(View2d<const std::uint8_t> rgb);

}  // namespace lightcal::app
