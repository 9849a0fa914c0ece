// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/numbers_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace lightcal {

std::string ShortestText(double value) {
  std::array<char, 40> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value == 0.0 ? 0.0 : value).ptr;
  return {buffer.data(), end};
}

std::string RoundedText(double value, int significant_digits) {
  if (value == 0.0 || !std::isfinite(value)) return ShortestText(value);
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  std::array<char, 400> buffer{};
  if (exponent < -4 || exponent > 8) {
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                   std::chars_format::scientific, significant_digits - 1)
                         .ptr;
    return {buffer.data(), end};
  }
  const int decimals = std::max(0, significant_digits - 1 - exponent);
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, decimals)
                       .ptr;
  return {buffer.data(), end};
}

std::string PercentText(double relative, int significant_digits) {
  return RoundedText(100.0 * relative, significant_digits) + " %";
}

std::string_view TrimBlanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string LowerAscii(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return lower;
}

std::optional<double> ParseNumber(std::string_view text, bool decimal_comma) {
  std::string trimmed(TrimBlanks(text));
  if (decimal_comma) {
    if (trimmed.find('.') != std::string::npos) return std::nullopt;
    std::ranges::replace(trimmed, ',', '.');
  }
  if (trimmed.starts_with('+')) trimmed.erase(0, 1);
  if (trimmed.empty() || trimmed.starts_with('+')) return std::nullopt;
  double value = 0.0;
  const char* end = trimmed.data() + trimmed.size();
  const auto parsed = std::from_chars(trimmed.data(), end, value);
  if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace lightcal
