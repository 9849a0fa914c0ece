// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/units_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

struct UnitFactor {
  std::string_view unit;
  double si_per_unit;
};

constexpr UnitFactor kLengthUnits[] = {
    {"", 1.0},        {"m", 1.0},       {"cm", 0.01},      {"mm", 0.001},  {"km", 1000.0},
    {"in", 0.0254},   {"\"", 0.0254},   {"inch", 0.0254},  {"ft", 0.3048}, {"'", 0.3048},
    {"feet", 0.3048}, {"foot", 0.3048}, {"inches", 0.0254}};
constexpr UnitFactor kIlluminanceUnits[] = {
    {"", 1.0}, {"lx", 1.0}, {"lux", 1.0}, {"klx", 1000.0}, {"fc", kLuxPerFootcandle}};
constexpr UnitFactor kDurationUnits[] = {{"", 1.0},    {"s", 1.0},   {"sec", 1.0},
                                         {"ms", 1e-3}, {"us", 1e-6}, {"min", 60.0}};
constexpr UnitFactor kTemperatureUnits[] = {{"", 1.0}, {"k", 1.0}};
constexpr UnitFactor kAngleUnits[] = {{"", std::numbers::pi / 180.0},
                                      {"deg", std::numbers::pi / 180.0},
                                      {"\xC2\xB0", std::numbers::pi / 180.0},
                                      {"rad", 1.0}};

Result<double> ParseWith(std::string_view text, std::span<const UnitFactor> units,
                         std::string_view what) {
  const auto split = SplitNumberAndUnit(text);
  if (!split) return tl::unexpected(split.error());
  const std::string unit = LowerAscii(split->unit);
  std::string known;
  for (const UnitFactor& factor : units) {
    if (factor.unit == unit) return split->number * factor.si_per_unit;
    if (!factor.unit.empty()) known += (known.empty() ? "" : ", ") + std::string(factor.unit);
  }
  return WrongUsage(std::string(text), "unknown unit \"" + std::string(split->unit) + "\" for " +
                                           std::string(what) + "; use one of: " + known);
}

constexpr std::string_view kNumerals = "0123456789";

std::size_t CountNumerals(std::string_view text) {
  return std::min(text.find_first_not_of(kNumerals), text.size());
}

// Of a number with a comma after `before` of its characters: how it is to be typed.
std::string HowToType(std::string_view text, std::size_t before) {
  constexpr std::size_t kGroup = 3;
  std::string typed(text);
  typed[before] = '.';
  const std::string_view rest = text.substr(before + 1);
  const bool plain = CountNumerals(text) == before && before <= kGroup && text.front() != '0';
  if (plain && CountNumerals(rest) == kGroup) {  // may part thousands
    const bool kelvin = LowerAscii(TrimBlanks(rest.substr(kGroup))) == "k";
    const std::string whole = std::string(text.substr(0, before)) + std::string(rest);
    typed = kelvin ? whole : whole + " or " + typed;  // no light is of a few kelvin
  }
  return "decimals have a point here, and thousands no sign: " + typed;
}

// As typed, the marks of a typographer's too.
constexpr std::initializer_list<std::string_view> kInchWords = {
    "inches", "inch", "in", "\"", "''", "\xE2\x80\xB3", "\xE2\x80\x9D"};
constexpr std::initializer_list<std::string_view> kFootWords = {
    "feet", "foot", "ft", "'", "\xE2\x80\xB2", "\xE2\x80\x99"};

// Takes the first of `words` that stands at the front, with the blanks before it.
bool TakeWord(std::string_view& text, std::initializer_list<std::string_view> words) {
  const std::string_view content = TrimBlanks(text);
  for (const std::string_view word : words) {
    if (!content.starts_with(word)) continue;
    text = content.substr(word.size());
    return true;
  }
  return false;
}

// "8", "8.5", "8 1/2", "8-1/2" or "1/2" of a tape measure, taken off the front.
std::optional<double> TakeTapeNumber(std::string_view& text) {
  text = TrimBlanks(text);
  const auto take = [&text](std::string_view characters) {
    const std::size_t end = std::min(text.find_first_not_of(characters), text.size());
    const std::string_view taken = text.substr(0, end);
    text.remove_prefix(end);
    return taken;
  };
  const std::string_view first = take("0123456789.");
  const auto whole = ParseNumber(first);
  if (!whole) return std::nullopt;
  const bool is_whole = first.find('.') == std::string_view::npos;
  const auto over = [&](double above) -> std::optional<double> {
    text.remove_prefix(1);
    const auto below = ParseNumber(take(kNumerals));
    if (!below || !(*below > 0.0)) return std::nullopt;
    return above / *below;
  };
  if (text.starts_with('/')) return is_whole ? over(*whole) : std::nullopt;
  std::string_view ahead = text;
  const std::string_view gap = take(" -");
  const auto above = ParseNumber(take(kNumerals));
  if (gap.empty() || !above || !text.starts_with('/') || !is_whole) {
    text = ahead;
    return whole;
  }
  const auto part = over(*above);
  if (!part) return std::nullopt;
  return *whole + *part;
}

// "1ft8in" "1'8\"" "5' 8 1/2\"" "5 ft 8" "8 1/2 in" in metres; absent for what is not of a tape
// measure.
std::optional<double> FeetAndInches(std::string_view written) {
  const std::string lower = LowerAscii(TrimBlanks(written));
  std::string_view text = lower;
  const bool minus = TakeWord(text, {"-"});
  const auto first = TakeTapeNumber(text);
  if (!first) return std::nullopt;
  double inches = *first;
  if (!TakeWord(text, kInchWords)) {
    if (!TakeWord(text, kFootWords)) return std::nullopt;
    constexpr double kInchesPerFoot = 12.0;
    inches *= kInchesPerFoot;
    (void)TakeWord(text, {"-"});
    if (!TrimBlanks(text).empty()) {
      const auto more = TakeTapeNumber(text);
      if (!more || !(*more < kInchesPerFoot)) return std::nullopt;
      (void)TakeWord(text, kInchWords);
      inches += *more;
    }
  }
  if (!TrimBlanks(text).empty()) return std::nullopt;
  constexpr double kMetresPerInch = 0.0254;
  return (minus ? -inches : inches) * kMetresPerInch;
}

// "EV10", "10.3EV", "f/5.6": what an incident meter shows for cameras. E = C 2^EV / 100 at ISO 100,
// and C (ISO 2720) is the receptor's: about 250 flat, 340 under a dome.
std::optional<Error> IncidentExposure(std::string_view written) {
  constexpr double kFlat = 2.5, kDome = 3.4;  // C / 100 [lx]
  const std::string lower = LowerAscii(TrimBlanks(written));
  std::string_view text = lower;
  if (text.starts_with("f/") && ParseNumber(TrimBlanks(text.substr(2)))) {
    return WrongUsage(std::string(written),
                      "a stop goes with a shutter and an ISO, and says no light alone: set the "
                      "meter to lux or footcandles")
        .value();
  }
  bool is_ev = TakeWord(text, {"ev"});
  if (!is_ev && text.ends_with("ev")) {
    is_ev = true;
    text.remove_suffix(2);
  }
  const auto ev = ParseNumber(TrimBlanks(text));
  if (!is_ev || !ev || !(std::abs(*ev) < 40.0)) return std::nullopt;
  return WrongUsage(std::string(written),
                    "an incident meter's EV at ISO 100 is " +
                        RoundedText(kFlat * std::exp2(*ev), 3) +
                        " lx under its flat receptor (2.5 lx x 2^EV) and about " +
                        RoundedText(kDome * std::exp2(*ev), 3) +
                        " lx under its dome: type the lux of yours, flat and facing the lamp, or "
                        "set the meter to lux or footcandles")
      .value();
}

template <class Unit>
Result<Unit> Wrap(Result<double>&& number) {
  if (!number) return Propagate(std::move(number));
  return Unit(*number);
}

}  // namespace

Result<NumberWithUnit> SplitNumberAndUnit(std::string_view text) {
  const std::string_view trimmed = TrimBlanks(text);
  std::size_t end = 0;
  while (end < trimmed.size()) {
    const char c = trimmed[end];
    const bool exponent =
        (c == 'e' || c == 'E') && end + 1 < trimmed.size() && end > 0 &&
        (std::string_view("+-0123456789").find(trimmed[end + 1]) != std::string_view::npos);
    if (std::string_view("+-.0123456789/").find(c) == std::string_view::npos && !exponent) break;
    end += exponent ? 2 : 1;
  }
  const std::string_view number = trimmed.substr(0, end);
  const std::string_view unit = TrimBlanks(trimmed.substr(end));
  if (!number.empty() && unit.starts_with(',') && CountNumerals(unit.substr(1)) > 0) {
    return WrongUsage(std::string(text), HowToType(trimmed, end));
  }
  const auto slash = number.find('/');
  if (slash != std::string_view::npos) {
    const auto above = ParseNumber(number.substr(0, slash));
    const auto below = ParseNumber(number.substr(slash + 1));
    if (above && below && *below != 0.0) return NumberWithUnit{*above / *below, unit};
  } else if (const auto value = ParseNumber(number)) {
    return NumberWithUnit{*value, unit};
  }
  // Whoever names another subject (a question's flag) still says which word it is.
  return WrongUsage(
      std::string(text),
      "a number is needed here, with an optional unit, for example 0.5m or 192lx; \"" +
          std::string(trimmed) + "\" is none");
}

bool IsOverloadWord(std::string_view text) {
  constexpr std::array<std::string_view, 6> kWords = {"ol",       "o.l.",      "over",
                                                      "overload", "overrange", "over range"};
  return std::ranges::find(kWords, LowerAscii(TrimBlanks(text))) != kWords.end();
}

char LimitSignOf(std::string_view text) {
  const std::string_view content = TrimBlanks(text);
  return content.starts_with('>') || content.starts_with('<') ? content.front() : '\0';
}

Result<Metres> ParseLength(std::string_view text) {
  auto length = ParseWith(text, kLengthUnits, "a length");
  if (!length) {
    if (const auto metres = FeetAndInches(text)) return Metres(*metres);
  }
  return Wrap<Metres>(std::move(length));
}
Result<Lux> ParseIlluminance(std::string_view text) {
  if (auto exposure = IncidentExposure(text)) return tl::unexpected(*std::move(exposure));
  return Wrap<Lux>(ParseWith(text, kIlluminanceUnits, "an illuminance"));
}
Result<Seconds> ParseDuration(std::string_view text) {
  return Wrap<Seconds>(ParseWith(text, kDurationUnits, "a time"));
}
Result<Kelvin> ParseTemperature(std::string_view text) {
  return Wrap<Kelvin>(ParseWith(text, kTemperatureUnits, "a colour temperature"));
}
Result<Radians> ParseAngle(std::string_view text) {
  return Wrap<Radians>(ParseWith(text, kAngleUnits, "an angle"));
}
Result<double> ParseFNumber(std::string_view text) {
  std::string_view trimmed = TrimBlanks(text);
  if (trimmed.starts_with("f/") || trimmed.starts_with("F/")) trimmed.remove_prefix(2);
  const auto value = ParseNumber(trimmed);
  if (!value || *value <= 0.0) {
    return WrongUsage(std::string(text), "an f-number above zero is needed, for example f/2.8");
  }
  return *value;
}

}  // namespace lightcal
