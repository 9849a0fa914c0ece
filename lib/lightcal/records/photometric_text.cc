// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/photometric_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "lightcal/core/numbers_text.h"

namespace lightcal::records {
namespace {

constexpr std::size_t kLongestField = 256;

// Length of the UTF-8 sequence at the front, 0 where there is none; its code point in `code`.
std::size_t Utf8At(std::string_view s, char32_t& code) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80U) {
    code = first;
    return 1;
  }
  const std::size_t length = first >= 0xF0U ? 4 : (first >= 0xE0U ? 3 : 2);
  if (first < 0xC2U || first > 0xF4U || s.size() < length) return 0;
  code = first & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  const bool overlong = (length == 3 && code < 0x800U) || (length == 4 && code < 0x10000U);
  return overlong || (code >= 0xD800U && code < 0xE000U) || code > 0x10FFFFU ? 0 : length;
}

bool IsUtf8(std::string_view s) {
  char32_t code = 0;
  while (!s.empty()) {
    const std::size_t n = Utf8At(s, code);
    if (n == 0) return false;
    s.remove_prefix(n);
  }
  return true;
}

std::string Narrowed(std::string_view utf8, char32_t last) {
  std::string out;
  char32_t code = 0;
  while (!utf8.empty()) {
    const std::size_t n = std::max<std::size_t>(1, Utf8At(utf8, code));
    out += code <= last ? static_cast<char>(code) : '?';
    utf8.remove_prefix(n);
  }
  return out;
}

}  // namespace

Lines::Lines(std::string_view text) : rest_(text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

std::optional<std::string_view> Lines::Next() {
  if (rest_.empty()) return std::nullopt;
  const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end);
  if (rest_.starts_with("\r\n")) rest_.remove_prefix(1);
  if (!rest_.empty()) rest_.remove_prefix(1);
  ++number_;
  return TrimBlanks(line);
}

std::optional<double> NumberEitherWay(std::string_view text) {
  // Nothing that long is a number; the parser copies what it is given.
  constexpr std::size_t kLongestNumber = 64;
  if (text.size() > kLongestNumber) return std::nullopt;
  return ParseNumber(text, text.find(',') != std::string_view::npos);
}

std::string PlainNumber(double value, int digits) {
  if (value == 0.0) return "0";
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  std::array<char, 700> buffer{};
  const int decimals = std::clamp(digits - 1 - exponent, 0, 40);
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, decimals)
                       .ptr;
  std::string text(buffer.data(), end);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string HeaderText(std::string_view bytes) {
  bytes = TrimBlanks(TrimBlanks(bytes).substr(0, kLongestField));
  // A cut may have split a character.
  std::string_view whole = bytes;
  for (int i = 0; i < 3 && !whole.empty() && !IsUtf8(whole); ++i) whole.remove_suffix(1);
  const bool cut = bytes.size() == kLongestField && IsUtf8(whole);
  std::string out;
  if (cut || IsUtf8(bytes)) {
    out = cut ? whole : bytes;
  } else {
    for (const char c : bytes) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 0x80U) {
        out += c;
      } else {
        out += static_cast<char>(0xC0U | (byte >> 6U));
        out += static_cast<char>(0x80U | (byte & 0x3FU));
      }
    }
  }
  std::ranges::replace_if(
      out, [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; }, ' ');
  return std::string(TrimBlanks(out));
}

std::string AsciiFromUtf8(std::string_view utf8) { return Narrowed(utf8, 0x7E); }
std::string Latin1FromUtf8(std::string_view utf8) { return Narrowed(utf8, 0xFF); }

tl::unexpected<Error> BadPhotometric(std::string_view where, const std::string& why) {
  return Refused("bad_photometric", std::string(where), why);
}

tl::unexpected<Error> AnglesMustIncrease(std::string_view where, std::string_view which,
                                         double before, double angle, int line) {
  return Refused("bad_table", std::string(where),
                 std::string(which) + " angles must increase: " + ShortestText(angle) + " after " +
                     ShortestText(before) + ", line " + std::to_string(line));
}

}  // namespace lightcal::records
