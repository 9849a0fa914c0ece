// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/printable.h"

#include <cstddef>
#include <cstdint>

namespace lightcal {
namespace {

constexpr std::uint32_t kBroken = 0xFFFD;

struct CodePoint {
  std::uint32_t value = kBroken;
  std::size_t bytes = 1;
  bool whole = false;
};

// The first of a text that is not empty.   Source: Unicode 15, table 3-7.
CodePoint FirstOf(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(text[i]) & 0xFFU; };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t count = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < count) return {};
  std::uint32_t value = lead & (0x7FU >> count);
  for (std::size_t i = 1; i < count; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return {};
    value = (value << 6U) | (byte(i) & 0x3FU);
  }
  const bool too_long = (count == 3 && value < 0x800) || (count == 4 && value < 0x10000);
  if (too_long || value > 0x10FFFF || (value >= 0xD800 && value < 0xE000)) return {};
  return {value, count, true};
}

bool Steers(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7F && c <= 0x9F) || c == 0x61C || c == 0x200E || c == 0x200F ||
         (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

}  // namespace

bool IsPrintable(std::string_view utf8) {
  while (!utf8.empty()) {
    const CodePoint c = FirstOf(utf8);
    if (!c.whole || Steers(c.value)) return false;
    utf8.remove_prefix(c.bytes);
  }
  return true;
}

std::string Printable(std::string_view utf8) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string shown;
  shown.reserve(utf8.size());
  while (!utf8.empty()) {
    const CodePoint c = FirstOf(utf8);
    const bool stays = c.value == '\n' || c.value == '\t' || !Steers(c.value);
    if (!c.whole) {
      shown += "\xEF\xBF\xBD";
    } else if (stays) {
      shown += utf8.substr(0, c.bytes);
    } else {
      shown += "\\u";
      for (unsigned int shift = 16; shift > 0; shift -= 4) {
        shown += kHex[(c.value >> (shift - 4)) & 0xFU];
      }
    }
    utf8.remove_prefix(c.bytes);
  }
  return shown;
}

}  // namespace lightcal
