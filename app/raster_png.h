// SPDX-License-Identifier: Apache-2.0
// Pixels as a PNG file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "lightcal/core/view2d.h"

namespace lightcal::app {

// 8 bit RGB, rows of width x 3 samples, sRGB-encoded. Same pixels, same bytes.
// Source: ISO/IEC 15948:2004.
[[nodiscard]] std::string EncodePng(View2d<const std::uint8_t> rgb);

// The same file as a data: URI.
[[nodiscard]] std::string PngUri(View2d<const std::uint8_t> rgb);

// A chunk of a PNG file: length, type, data, check sum.  Source: ISO/IEC 15948:2004, 5.3.
[[nodiscard]] std::string PngChunk(const std::string& type, const std::string& data);

// Bytes as base64 text (RFC 4648), as data: URIs hold them.
[[nodiscard]] std::string Base64(std::string_view bytes);

}  // namespace lightcal::app
