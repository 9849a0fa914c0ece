// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/png.h"

#include <array>

#include "lightcal/core/crc32.h"

namespace lightcal {
namespace {

// One byte's share of the check sum (ISO/IEC 15948:2004, annex D).
constexpr std::array<std::uint32_t, 256> kCrcOfByte = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0U ? 0xEDB88320U : 0U);
    table[byte] = crc;
  }
  return table;
}();

}  // namespace

std::uint32_t Crc32(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc = kCrcOfByte[(crc ^ static_cast<unsigned char>(byte)) & 0xFFU] ^ crc >> 8U;
  }
  return ~crc;
}

std::string BigEndian(std::uint32_t value) {
  std::string bytes;
  for (unsigned shift = 32; shift > 0; shift -= 8) {
    bytes += static_cast<char>(value >> (shift - 8) & 0xFFU);
  }
  return bytes;
}

std::string PngChunk(std::string_view type, std::string_view data) {
  const std::string body = std::string(type).append(data);
  return BigEndian(static_cast<std::uint32_t>(data.size())) + body + BigEndian(Crc32(body));
}

std::string PngFile(int width, int height, PngColor color, std::string_view packed) {
  constexpr char kEightBits = 8;
  std::string header =
      BigEndian(static_cast<std::uint32_t>(width)) + BigEndian(static_cast<std::uint32_t>(height));
  header += {kEightBits, static_cast<char>(color), 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" + PngChunk("IHDR", header) + PngChunk("IDAT", packed) +
         PngChunk("IEND", "");
}

}  // namespace lightcal
