// SPDX-License-Identifier: Apache-2.0
// OpenEXR files written byte by byte: one channel Y of 32 bit floats, uncompressed scanlines, and
// any attributes besides. Includes no header of lightcal or OpenEXR.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lightcal::test {

struct ExrAttribute {
  std::string name, type, bytes;
};

// The bytes of numbers, as this (little endian) machine has them.
template <class... Numbers>
[[nodiscard]] std::string BytesOf(Numbers... numbers) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof(numbers)), ...);
  return bytes;
}

[[nodiscard]] inline ExrAttribute FloatOf(std::string name, float value) {
  return {std::move(name), "float", BytesOf(value)};
}

// Source: OpenEXR, "OpenEXR File Layout".
[[nodiscard]] inline std::string EncodeExr(int width, int height, const std::vector<float>& samples,
                                           const std::vector<ExrAttribute>& more = {}) {
  std::string bytes = BytesOf(std::int32_t{20000630}, std::int32_t{2});
  const auto put = [&](const ExrAttribute& attribute) {
    bytes += attribute.name + '\0' + attribute.type + '\0' +
             BytesOf(static_cast<std::int32_t>(attribute.bytes.size())) + attribute.bytes;
  };
  const std::string window =
      BytesOf(std::int32_t{0}, std::int32_t{0}, std::int32_t{width - 1}, std::int32_t{height - 1});
  put({"channels", "chlist",
       std::string("Y\0", 2) +
           BytesOf(std::int32_t{2}, std::int32_t{0}, std::int32_t{1}, std::int32_t{1}) + '\0'});
  put({"compression", "compression", std::string(1, '\0')});
  put({"dataWindow", "box2i", window});
  put({"displayWindow", "box2i", window});
  put({"lineOrder", "lineOrder", std::string(1, '\0')});
  put({"pixelAspectRatio", "float", BytesOf(1.0F)});
  put({"screenWindowCenter", "v2f", BytesOf(0.0F, 0.0F)});
  put({"screenWindowWidth", "float", BytesOf(1.0F)});
  for (const ExrAttribute& attribute : more) put(attribute);
  bytes += '\0';
  const std::size_t row = 4 * static_cast<std::size_t>(width);
  const std::size_t first = bytes.size() + 8 * static_cast<std::size_t>(height);
  for (int y = 0; y < height; ++y) {
    bytes += BytesOf(static_cast<std::uint64_t>(first + static_cast<std::size_t>(y) * (8 + row)));
  }
  for (int y = 0; y < height; ++y) {
    bytes += BytesOf(std::int32_t{y}, static_cast<std::int32_t>(row));
    bytes.append(reinterpret_cast<const char*>(&samples[static_cast<std::size_t>(y * width)]), row);
  }
  return bytes;
}

}  // namespace lightcal::test
