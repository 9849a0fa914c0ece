// SPDX-License-Identifier: Apache-2.0
// plain_exr.h's pictures with half floats, infinity among them. Includes no header of lightcal or
// OpenEXR.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "plain_exr.h"

namespace lightcal::test {

// The bits of 0, infinity, or a value between 2^-14 and 65519.
// Source: IEEE 754-2019, binary16.
[[nodiscard]] inline std::uint16_t HalfBits(float value) {
  if (std::isinf(value)) return 0x7C00;
  if (value == 0.0F) return 0;
  int exponent = 0;
  const float mantissa = std::frexp(value, &exponent);  // 0.5 to 1
  const auto bits = static_cast<int>(std::lround(mantissa * 2048.0F)) - 1024;
  return static_cast<std::uint16_t>((exponent + 14) * 1024 + bits);
}

[[nodiscard]] inline std::string EncodeHalfExr(int width, int height,
                                               const std::vector<float>& samples) {
  std::string bytes = EncodeExr(width, height, samples);
  const auto rows = static_cast<std::size_t>(height);
  const std::size_t row = 2 * static_cast<std::size_t>(width);
  bytes.resize(bytes.size() - rows * (8 + 8 + 2 * row));  // the header is left
  const std::string channel = std::string("Y\0", 2) + BytesOf(std::int32_t{2});
  bytes.replace(bytes.find(channel), channel.size(),
                std::string("Y\0", 2) + BytesOf(std::int32_t{1}));
  const std::size_t first = bytes.size() + 8 * rows;
  for (std::size_t y = 0; y < rows; ++y) {
    bytes += BytesOf(static_cast<std::uint64_t>(first + y * (8 + row)));
  }
  for (std::size_t y = 0; y < rows; ++y) {
    bytes += BytesOf(static_cast<std::int32_t>(y), static_cast<std::int32_t>(row));
    for (std::size_t x = 0; x < row / 2; ++x) bytes += BytesOf(HalfBits(samples[y * row / 2 + x]));
  }
  return bytes;
}

}  // namespace lightcal::test
