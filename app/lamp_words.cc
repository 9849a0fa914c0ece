// SPDX-License-Identifier: Apache-2.0
#include "lamp_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "console.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/stops.h"

namespace lightcal::app {
namespace {

constexpr std::size_t kColumns = 100;
constexpr std::size_t kLabelColumns = 18;

int DigitsOf(double value, double half_width) {
  if (!(half_width > 0.0) || value == 0.0) return 3;
  const double unit = std::floor(std::log10(half_width)) - 1.0;
  return std::clamp(static_cast<int>(std::floor(std::log10(std::abs(value))) - unit) + 1, 2, 5);
}

double LowOf(const Uncertain& u) { return std::max(0.0, u.low.value_or(u.value - u.u95)); }
double HighOf(const Uncertain& u) { return u.high.value_or(u.value + u.u95); }

// "1.61", "0.9, 0.7, 0.4": three digits of each number.
std::string Typed(const std::string& value) {
  std::string out;
  std::size_t begin = 0;
  while (begin <= value.size()) {
    const std::size_t comma = std::min(value.find(", ", begin), value.size());
    const std::string one = value.substr(begin, comma - begin);
    const auto number = ParseNumber(one);
    out += (out.empty() ? "" : ", ") + (number ? Rounded(*number, 3) : one);
    begin = comma + 2;
  }
  return out;
}

std::string ShortName(std::string_view title) {
  if (title == "Unreal Engine") return "Unreal";
  if (title == "Unity HDRP") return "Unity";
  return std::string(title);
}

std::string WithIt(const EngineFigure& figure) {
  std::string with;
  if (!figure.kelvin.empty()) {
    with = " + " + figure.kelvin;
  } else if (HasColor(figure)) {
    with = " + colour";
  }
  if (!figure.with.empty()) with += " + " + figure.with;
  if (!figure.file.empty()) with += " + its " + figure.file;
  return with;
}

// "0.37", "0.10", "0.08", "1.2".
std::string StopsDigits(double stops) {
  constexpr double kTenth = 0.1, kRoundsToIt = 0.0995;
  return stops < kRoundsToIt ? RoundedText(stops, 1) : RoundedText(std::max(stops, kTenth), 2);
}

// Where the first word ends, the blanks before it included: a sign keeps its number, and a line to
// type stays in one piece.
std::size_t EndOfWord(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
  const std::string_view word = text.substr(begin);
  constexpr std::string_view kCommand = "lightcal ";
  if (word.starts_with(kCommand)) return std::min(text.find(": ±", begin), text.size());
  std::size_t end = std::min(text.find(' ', begin), text.size());
  if (word.starts_with("± ")) end = std::min(text.find(' ', end + 1), text.size());
  return end;
}

}  // namespace

std::string DegreesText(Radians angle) {
  return ShortestText(std::round(10.0 * DegreesFromRadians(angle)) / 10.0);
}

Strength StrengthOf(const FittedLight& light) {
  if (light.intensity_cd) return {&*light.intensity_cd, "cd"};
  if (light.illuminance_lx) return {&*light.illuminance_lx, "lx"};
  if (light.luminance_nits) return {&*light.luminance_nits, "cd/m²"};
  if (light.flux_lm) return {&*light.flux_lm, "lm"};
  return {};
}

std::string Rounded(double value, int digits) {
  if (value == 0.0) return "0";
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1 - digits);
  if (unit <= 1.0) return RoundedText(value, digits);
  return RoundedText(std::round(value / unit) * unit, 1);
}

std::string BareStops(double stops) {
  std::string text = StopsDigits(stops);
  if (text.starts_with("0.")) text.erase(0, 1);
  return text;
}

bool HasColor(const EngineFigure& figure) {
  return !figure.color.empty() && !figure.color.starts_with("1, 1, 1 ") &&
         !figure.color.starts_with("255, 255, 255 ");
}

// "Blender 1.61 W · Unity, glTF 87 cd + colour"
std::string TypeIn(const std::vector<EngineFigure>& figures) {
  std::vector<std::pair<std::string, std::string>> groups;  // what is typed, by whom
  for (const EngineFigure& figure : figures) {
    std::string typed = Typed(figure.value);
    if (!figure.unit.empty()) typed += " " + figure.unit;
    if (!figure.size.empty()) typed += " at " + figure.size;
    if (!figure.before.empty()) typed += " (" + figure.before + ")";
    typed += WithIt(figure);
    const auto same = std::ranges::find(groups, typed, &std::pair<std::string, std::string>::first);
    const std::string name = ShortName(figure.engine);
    if (same == groups.end()) {
      groups.emplace_back(typed, name);
    } else {
      same->second += ", " + name;
    }
  }
  return Joined(groups, " · ", [](const auto& one) { return one.second + " " + one.first; });
}

std::string Cones(const std::vector<EngineFigure>& figures) {
  std::string text;
  for (const EngineFigure& figure : figures) {
    if (figure.cone.empty()) continue;
    text += (text.empty() ? "" : " · ") + ShortName(figure.engine) + " " + figure.cone;
  }
  return text;
}

std::string LabelledLine(const std::string& label, const std::string& text) {
  const auto width = [](std::string_view words) {
    return static_cast<std::size_t>(std::ranges::count_if(
        words, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
  };
  std::string out = label;
  std::size_t column = width(label);
  const auto indent = [&] {
    const std::size_t gap = column + 2 > kLabelColumns ? 2 : kLabelColumns - column;
    out += std::string(gap, ' ');
    column += gap;
  };
  indent();
  bool first = true;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t blank = EndOfWord(rest);
    std::string_view word = rest.substr(0, blank);
    rest.remove_prefix(blank);
    if (!first && column + width(word) > kColumns) {
      word = TrimBlanks(word);
      out += "\n";
      column = 0;
      indent();
    }
    out += word;
    column += width(word);
    first = false;
  }
  return out + "\n";
}

std::string StopsText(double stops) {
  return "± " + StopsDigits(stops) + (stops <= 1.0 ? " stop" : " stops");
}

std::string StopsText(const Uncertain& u) {
  const auto stops = HalfWidthStops(u);
  return stops ? StopsText(*stops) : "";
}

std::string ValueText(const Uncertain& u) {
  return Rounded(u.value, DigitsOf(u.value, 0.5 * (HighOf(u) - LowOf(u))));
}

std::string ValueAndInterval(const Uncertain& u, std::string_view unit) {
  if (IsEven(u)) return ValueWithPercent(u.value, 0.5 * (HighOf(u) - LowOf(u)), unit);
  return ValueText(u) + " " + std::string(unit) + ", " + RangeText(u);
}

std::string KelvinText(const Uncertain& cct) {
  if (IsEven(cct)) return ValueWithAbsolute(cct.value, cct.u95, "K");
  return ValueText(cct) + " K, " + RangeText(cct);
}

std::string UpperEndText(const Uncertain& u) { return Rounded(HighOf(u), 2); }

std::string RangeText(const Uncertain& u) {
  const double half = 0.5 * (HighOf(u) - LowOf(u));
  const auto end = [&](double value) { return Rounded(value, DigitsOf(value, half)); };
  return end(LowOf(u)) + " … " + end(HighOf(u));
}

std::string EnoughFor(double stops) {
  constexpr std::array<std::pair<double, std::string_view>, 3> kUses = {
      {{0.1, "measurement"}, {0.2, "matching plates"}, {0.5, "look-dev"}}};
  for (const auto& [most, use] : kUses) {
    if (stops <= most) return std::string(use);
  }
  return "";
}

}  // namespace lightcal::app
