// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/number_notation.h"

#include <algorithm>
#include <array>

#include "lightcal/core/numbers_text.h"

namespace lightcal::devices::files {
namespace {

constexpr std::string_view kNumerals = "0123456789";
constexpr std::size_t kGroup = 3;

bool IsNumeral(char c) { return c >= '0' && c <= '9'; }

// Blanks of any width and apostrophes, where they stand between digits, as one apostrophe.
std::string WithApostrophes(std::string_view cell) {
  constexpr std::array<std::string_view, 6> kParting = {
      " ", "'", "\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89", "\xE2\x80\x99"};
  std::string out;
  for (std::size_t i = 0; i < cell.size();) {
    const std::string_view rest = cell.substr(i);
    const auto sign = std::ranges::find_if(
        kParting, [&](std::string_view parting) { return rest.starts_with(parting); });
    const bool between = sign != kParting.end() && !out.empty() && IsNumeral(out.back()) &&
                         rest.size() > sign->size() && IsNumeral(rest[sign->size()]);
    out += between ? '\'' : cell[i];
    i += between ? sign->size() : 1;
  }
  return out;
}

// Whether `sign` parts the digits into groups of three behind a first one of one to three.
bool PartsThousands(std::string_view digits, char sign) {
  const std::size_t first = digits.find(sign);
  if (first == std::string_view::npos || first == 0 || first > kGroup || digits[0] == '0') {
    return false;
  }
  for (std::size_t at = first; at != std::string_view::npos; at = digits.find(sign, at + 1)) {
    const std::string_view group = digits.substr(at + 1, kGroup);
    const std::size_t end = at + 1 + kGroup;
    if (group.size() < kGroup || !std::ranges::all_of(group, IsNumeral)) return false;
    if (end < digits.size() && digits[end] != sign) return false;
  }
  return std::ranges::all_of(digits.substr(0, first), IsNumeral);
}

// A number's digits and signs, without its own sign and exponent.
struct Mantissa {
  std::string digits;
  bool exponent = false;
};
// Absent where the cell is no number in any notation.
std::optional<Mantissa> MantissaOf(std::string_view cell) {
  std::string text = WithApostrophes(TrimBlanks(cell));
  if (text.ends_with('%')) text = TrimBlanks(text.substr(0, text.size() - 1));
  if (text.starts_with('+') || text.starts_with('-')) text.erase(0, 1);
  const std::size_t e = text.find_first_of("eE");
  Mantissa mantissa{text.substr(0, e), e != std::string::npos};
  const bool numeric = mantissa.digits.find_first_of(kNumerals) != std::string::npos &&
                       mantissa.digits.find_first_not_of("0123456789.,'") == std::string::npos;
  if (!numeric) return std::nullopt;
  if (mantissa.exponent && !ParseNumber("1" + text.substr(e))) return std::nullopt;
  return mantissa;
}

}  // namespace

SignsOfCell SignsOf(std::string_view cell) {
  SignsOfCell signs;
  if (cell.find_first_of(",.") == std::string_view::npos) return signs;
  const auto mantissa = MantissaOf(cell);
  if (!mantissa) return signs;
  const std::string& digits = mantissa->digits;
  const auto tell = [&](char sign, bool decimal) {
    if (sign == ',') (decimal ? signs.comma_decimal : signs.comma_parts) = true;
    if (sign == '.') (decimal ? signs.point_decimal : signs.point_parts) = true;
  };
  const std::size_t last = digits.find_last_of(",.'");
  const char sign = digits[last];
  if (sign == '\'') return signs;  // 1.234'567 is no number
  const std::string whole = digits.substr(0, last);
  const std::size_t before = whole.find_first_of(",.'");
  if (before == std::string::npos) {
    if (!mantissa->exponent && PartsThousands(digits, sign)) {
      signs.open = sign;
    } else {
      tell(sign, true);
    }
    return signs;
  }
  if (!PartsThousands(digits[before] == sign ? digits : whole, digits[before])) return signs;
  tell(digits[before], false);
  if (digits[before] != sign) tell(sign, true);
  return signs;
}

std::optional<double> NumberIn(std::string_view cell, const NumberNotation& notation) {
  const bool comma = notation.decimal == ',';
  cell = TrimBlanks(cell);
  if (auto plain = ParseNumber(cell, comma)) return plain;
  std::string text = WithApostrophes(cell);
  const std::size_t start = text.find_first_of(kNumerals);
  const std::size_t end = std::min(text.find(notation.decimal), text.size());
  if (start == std::string::npos || start >= end) return std::nullopt;
  for (const char sign : {'\'', notation.thousands}) {
    if (sign == '\0' || !PartsThousands(std::string_view(text).substr(start, end - start), sign)) {
      continue;
    }
    std::erase(text, sign);
    return ParseNumber(text, comma);
  }
  return std::nullopt;
}

TwoMeanings MeaningsOf(std::string_view open_cell) {
  const bool comma = open_cell.find(',') != std::string_view::npos;
  const char other = comma ? '.' : ',';
  return {NumberIn(open_cell, {other, comma ? ',' : '.'}).value_or(0.0),
          NumberIn(open_cell, {comma ? ',' : '.', '\0'}).value_or(0.0)};
}

}  // namespace lightcal::devices::files
