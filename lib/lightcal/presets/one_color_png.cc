// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/one_color_png.h"

#include <span>
#include <string_view>

namespace lightcal {
namespace {

using Bytes = std::vector<std::uint8_t>;

void AppendBigEndian(Bytes& bytes, std::uint32_t value) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift & 0xFFU));
  }
}

std::uint32_t Crc32(std::span<const std::uint8_t> bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0U ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

std::uint32_t Adler32(std::span<const std::uint8_t> bytes) {
  constexpr std::uint32_t kPrime = 65521;
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t byte : bytes) {
    a = (a + byte) % kPrime;
    b = (b + a) % kPrime;
  }
  return b << 16U | a;
}

void AppendChunk(Bytes& png, std::string_view type, const Bytes& data) {
  AppendBigEndian(png, static_cast<std::uint32_t>(data.size()));
  Bytes checked(type.begin(), type.end());
  checked.insert(checked.end(), data.begin(), data.end());
  png.insert(png.end(), checked.begin(), checked.end());
  AppendBigEndian(png, Crc32(checked));
}

// One stored block.
Bytes ZlibStored(const Bytes& data) {
  const auto size = static_cast<std::uint32_t>(data.size());
  const auto low = [](std::uint32_t v) { return static_cast<std::uint8_t>(v & 0xFFU); };
  Bytes out = {0x78, 0x01, 0x01, low(size), low(size >> 8U), low(~size), low(~size >> 8U)};
  out.insert(out.end(), data.begin(), data.end());
  AppendBigEndian(out, Adler32(data));
  return out;
}

}  // namespace

std::vector<std::uint8_t> PngOfOneColor(int side, const std::array<std::uint8_t, 4>& rgba) {
  Bytes header;
  AppendBigEndian(header, static_cast<std::uint32_t>(side));
  AppendBigEndian(header, static_cast<std::uint32_t>(side));
  for (const int field : {8, 6, 0, 0, 0}) header.push_back(static_cast<std::uint8_t>(field));
  Bytes rows;
  for (int y = 0; y < side; ++y) {
    rows.push_back(0);  // no filter
    for (int x = 0; x < side; ++x) rows.insert(rows.end(), rgba.begin(), rgba.end());
  }
  Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  AppendChunk(png, "IHDR", header);
  AppendChunk(png, "IDAT", ZlibStored(rows));
  AppendChunk(png, "IEND", {});
  return png;
}

}  // namespace lightcal
