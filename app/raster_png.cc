// SPDX-License-Identifier: Apache-2.0
#include "raster_png.h"

#include <zlib.h>

#include <cstddef>

namespace lightcal::app {
namespace {

std::string BigEndian(std::uint32_t value) {
  std::string bytes;
  for (unsigned shift = 32; shift > 0; shift -= 8) {
    bytes += static_cast<char>((value >> (shift - 8)) & 0xffU);
  }
  return bytes;
}

}  // namespace

std::string PngChunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto crc =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return BigEndian(static_cast<std::uint32_t>(data.size())) + body +
         BigEndian(static_cast<std::uint32_t>(crc));
}

std::string EncodePng(View2d<const std::uint8_t> rgb) {
  constexpr char kTrueColour = 2, kEightBits = 8;
  std::string rows;  // each with its filter type, 0 = none
  for (int y = 0; y < rgb.height(); ++y) {
    rows += '\0';
    const auto row = rgb.row(y);
    rows.append(reinterpret_cast<const char*>(row.data()), row.size());
  }
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
            reinterpret_cast<const Bytef*>(rows.data()), static_cast<uLong>(rows.size()),
            Z_DEFAULT_COMPRESSION);
  packed.resize(size);
  std::string header = BigEndian(static_cast<std::uint32_t>(rgb.width())) +
                       BigEndian(static_cast<std::uint32_t>(rgb.height()));
  header += {kEightBits, kTrueColour, 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" + PngChunk("IHDR", header) + PngChunk("IDAT", packed) +
         PngChunk("IEND", "");
}

std::string Base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group =
          (group << 8U) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[(group >> (18U - 6U * k)) & 0x3fU];
    }
  }
  return text;
}

std::string PngUri(View2d<const std::uint8_t> rgb) {
  return "data:image/png;base64," + Base64(EncodePng(rgb));
}

}  // namespace lightcal::app
