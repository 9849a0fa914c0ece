// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/tape.h"

#include <string_view>

namespace lightcal::devices {

std::string EscapedBytes(std::span<const std::byte> bytes) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text;
  for (const std::byte b : bytes) {
    const auto value = std::to_integer<unsigned>(b);
    if (value > ' ' && value <= '~' && value != '\\') {
      text += static_cast<char>(value);
    } else {
      text += "\\x";
      text += kHex[value >> 4U];
      text += kHex[value & 0xFU];
    }
  }
  return text;
}

}  // namespace lightcal::devices
