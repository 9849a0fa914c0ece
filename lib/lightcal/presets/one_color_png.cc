// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/one_color_png.h"

#include <vector>

#include "lightcal/core/png.h"

namespace lightcal {
namespace {

std::uint32_t Adler32(std::string_view bytes) {
  constexpr std::uint32_t kPrime = 65521;
  std::uint32_t a = 1, b = 0;
  for (const char byte : bytes) {
    a = (a + static_cast<unsigned char>(byte)) % kPrime;
    b = (b + a) % kPrime;
  }
  return b << 16U | a;
}

// One stored block.
std::string ZlibStored(const std::string& data) {
  const auto size = static_cast<std::uint32_t>(data.size());
  std::string out = {0x78, 0x01, 0x01};
  for (const std::uint32_t half : {size, ~size}) {
    out += {static_cast<char>(half & 0xFFU), static_cast<char>(half >> 8U & 0xFFU)};
  }
  return out + data + BigEndian(Adler32(data));
}

}  // namespace

std::string PngOfTexels(int side, std::span<const std::array<std::uint8_t, 4>> rgba) {
  std::string rows;
  for (int y = 0; y < side; ++y) {
    rows += '\0';  // no filter
    for (int x = 0; x < side; ++x) {
      const auto& texel = rgba[static_cast<std::size_t>(y * side + x)];
      rows.append(texel.begin(), texel.end());
    }
  }
  return PngFile(side, side, PngColor::kRgba, ZlibStored(rows));
}

std::string PngOfOneColor(int side, const std::array<std::uint8_t, 4>& rgba) {
  return PngOfTexels(
      side, std::vector<std::array<std::uint8_t, 4>>(static_cast<std::size_t>(side * side), rgba));
}

}  // namespace lightcal
