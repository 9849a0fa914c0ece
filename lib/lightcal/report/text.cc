// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "lightcal/core/interval_text.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::report {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
constexpr std::string_view kMinus = "\u2212";
constexpr std::string_view kThinSpace = "\u202F";

// Length of the UTF-8 sequence at the start of text, 0 when there is none (overlong forms,
// surrogates and code points beyond U+10FFFF are none).
std::size_t Utf8Length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80U) return 1;
  const std::size_t length = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (lead < 0xC2U || lead > 0xF4U || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  }
  const unsigned char second = byte(1);
  const bool overlong = (lead == 0xE0U && second < 0xA0U) || (lead == 0xF0U && second < 0x90U);
  const bool outside = (lead == 0xEDU && second > 0x9FU) || (lead == 0xF4U && second > 0x8FU);
  return overlong || outside ? 0 : length;
}

std::string_view EntityOf(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

// "12345.6" -> "12 345.6"; shorter integer parts stay.
std::string Grouped(const std::string& digits) {
  constexpr std::size_t kShortestGrouped = 5;
  const std::size_t whole = std::min(digits.find('.'), digits.size());
  if (whole < kShortestGrouped || digits.find('e') != std::string::npos) return digits;
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && i < whole && (whole - i) % 3 == 0) text += kThinSpace;
    text += digits[i];
  }
  return text;
}

std::string Signed(double value, std::string digits) {
  const bool zero = digits.find_first_of("123456789") == std::string::npos;
  return (value < 0.0 && !zero ? std::string(kMinus) : "") + Grouped(digits);
}

}  // namespace

std::string Escaped(std::string_view text) {
  std::string safe;
  while (!text.empty()) {
    const std::size_t length = Utf8Length(text);
    const char c = text[0];
    const bool control = length == 1 && (static_cast<unsigned char>(c) < 0x20U || c == 0x7F);
    if (length == 0 || (control && c != '\n' && c != '\t')) {
      safe += kReplacement;
    } else if (const std::string_view entity = EntityOf(c); !entity.empty()) {
      safe += entity;
    } else {
      safe += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return safe;
}

std::string Fixed(double value, int decimals) {
  const double step = std::pow(10.0, -decimals);
  const double magnitude =
      decimals < 0 ? std::round(std::abs(value) / step) * step : std::abs(value);
  std::array<char, 400> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), magnitude,
                                 std::chars_format::fixed, std::max(decimals, 0))
                       .ptr;
  return Signed(value, std::string(buffer.data(), end));
}

std::string Figure(double value) {
  if (value == 0.0) return "0";
  const double exponent = std::floor(std::log10(std::abs(value)));
  if (exponent < -5.0 || exponent > 8.0) return Signed(value, RoundedText(std::abs(value), 3));
  std::string digits = RoundedText(std::abs(value), 6);
  if (digits.find('.') != std::string::npos && digits.find('e') == std::string::npos) {
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
  }
  return Signed(value, digits);
}

int DecimalsFor(double u95) {
  return static_cast<int>(std::clamp(1.0 - std::floor(std::log10(u95)), -8.0, 8.0));
}

namespace {
std::string WithUnit(std::string text, std::string_view unit) {
  if (!unit.empty()) text += "\u00A0" + std::string(unit);
  return text;
}
int DecimalsOf(const Uncertain& u, double scale) {
  if (u.u95 > 0.0) return DecimalsFor(u.u95 * scale);
  return u.value == 0.0 ? 0 : DecimalsFor(std::abs(u.value * scale)) + 2;
}
// A small end beside a large one keeps two digits of its own.
std::string EndsOf(const Uncertain& u, double scale, int decimals) {
  const auto text = [&](double end) {
    return Fixed(end, end == 0.0 ? decimals : std::max(decimals, DecimalsFor(std::abs(end))));
  };
  return text(LowEnd(u) * scale) + " … " + text(HighEnd(u) * scale);
}
}  // namespace

std::string PlusMinus(const Uncertain& u, std::string_view unit, double scale) {
  const int decimals = DecimalsOf(u, scale);
  std::string text = Fixed(u.value * scale, decimals);
  if (u.u95 > 0.0 && !IsEven(u)) {
    return WithUnit(std::move(text), unit) + ", " + EndsOf(u, scale, decimals);
  }
  if (u.u95 > 0.0) text += " ±\u00A0" + Fixed(u.u95 * scale, decimals);
  return WithUnit(text, unit);
}

std::string RelativePlusMinus(const Uncertain& u) {
  std::string text = RelativeText(u);
  if (text.ends_with(" %")) text.replace(text.size() - 2, 1, "\u00A0");
  return text;
}

std::string Interval(const Uncertain& u, std::string_view unit) {
  const int decimals = DecimalsOf(u, 1.0);
  return WithUnit(EndsOf(u, 1.0, decimals), unit);
}

std::string Percent(const std::optional<double>& relative) {
  if (!relative) return "—";
  const double percent = *relative * 100.0;
  return Fixed(percent, percent == 0.0 ? 1 : std::clamp(DecimalsFor(std::abs(percent)), 0, 4)) +
         "\u00A0%";
}

std::string SignedPercent(double relative) {
  const double percent = relative * 100.0;
  const int decimals = std::abs(percent) < 10.0 ? 2 : 1;
  const std::string text = Fixed(percent, decimals);
  return (percent > 0.0 ? "+" : "") + text + "\u00A0%";
}

}  // namespace lightcal::report
