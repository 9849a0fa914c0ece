// SPDX-License-Identifier: Apache-2.0
#include "typed_reading.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include "calibration_options.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/core/units_text.h"

namespace lightcal::app {
namespace {

constexpr const char* kForm =
    "a reading is written ILLUMINANCE@DISTANCE, for example 192lx@0.5m or 52lx@1m,card=5lx";

bool BeginsWithDigit(const std::string& text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) != 0;
}
bool EndsWithDigit(const std::string& text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.back())) != 0;
}

// Whether the comma after part i stands within a number: "192,5lx@1m".
bool WithinNumber(const std::vector<std::string>& parts, std::size_t i) {
  const std::string& next = parts[i + 1];
  const bool color = next.ends_with('K') || next.ends_with('k');
  return EndsWithDigit(parts[i]) && BeginsWithDigit(next) && !color;
}

// Whether it may part thousands: "1,203lx", not "0,125lx", "1,203m" or "1.5,203lx".
bool MayPartThousands(const std::string& before, const std::string& after) {
  constexpr std::string_view kDigits = "0123456789";
  constexpr std::size_t kGroup = 3;
  const std::size_t start = before.find_last_not_of(kDigits) + 1;
  const bool group = std::min(after.find_first_not_of(kDigits), after.size()) == kGroup;
  const bool plain = start == 0 || (before[start - 1] != '.' && before[start - 1] != '@');
  return group && plain && before[start] != '0' && before.size() - start <= kGroup;
}

// The reading as it is to be typed where a number has a comma, which here begins the next part: as
// decimals, and what else it may mean.
tl::unexpected<Error> DecimalComma(const std::vector<std::string>& parts, const std::string& text) {
  std::string decimal = parts.front(), thousands = parts.front();
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    const bool within = WithinNumber(parts, i);
    decimal += (within ? "." : ",") + parts[i + 1];
    const bool parted = within && MayPartThousands(parts[i], parts[i + 1]);
    thousands += (parted ? "" : within ? "." : ",") + parts[i + 1];
  }
  const std::string either =
      thousands == decimal ? decimal : decimal + ", and thousands no sign: " + thousands;
  return WrongUsage(text, "decimals have a point here: " + either +
                              " (a comma begins the next part of a reading, such as card=5lx)");
}

// What a word without a distance looks like, where that is an option.
std::string MeantWithoutDistance(const std::string& text) {
  const bool kelvin = text.ends_with("K") || text.ends_with("k");
  if (kelvin && ParseLampTemperature(text)) return "a colour temperature is --cct " + text + "; ";
  if (text.ends_with("lm")) return "what the box says is --lumens " + text + "; ";
  if (text.ends_with("W")) return "what it draws is --watts " + text + "; ";
  if (text.ends_with("m") && ParseLength(text)) {
    return "each distance to predict at has its own --at " + text + "; ";
  }
  return "";
}

// No lamp gives more; a thousand times what the sun's own surface does.
constexpr double kMostLux = 1e12;
constexpr double kFarthestMetres = 1e6;

Result<Lux> NotNegative(const std::string& text) {
  Result<Lux> lux = ParseIlluminance(text);
  if (lux && !(lux->value() <= kMostLux)) {
    return Refused("bad_reading", text, "no lamp gives so many lux; look at the number and unit");
  }
  if (lux && lux->value() < 0.0) {
    return Refused("bad_reading", text, "an illuminance cannot be negative");
  }
  return lux;
}

// A place holds one value of each kind: which of two was meant nobody can tell.
Result<void> GivenTwice(const std::string& part, const char* what) {
  return WrongUsage(part, std::string("is a second ") + what +
                              " of one reading; leave one out, or type another reading");
}

// One word after a comma.
Result<void> AddPart(const std::string& part, const Reading& lit, bool& angle_given,
                     std::vector<Reading>& out) {
  const auto equals = part.find('=');
  const std::string key = part.substr(0, equals);
  if (equals != std::string::npos && (key == "card" || key == "off")) {
    const Result<Lux> lux = NotNegative(part.substr(equals + 1));
    if (!lux) return tl::unexpected(lux.error());
    Reading other = lit;
    other.off_axis = out.front().off_axis;
    other.illuminance = *lux;
    const bool card = key == "card";
    const auto of_its_kind = [&](const Reading& one) {
      return card ? one.shadow_card : one.lamp == LampState::kOff;
    };
    if (std::ranges::any_of(out, of_its_kind)) {
      return GivenTwice(part, card ? "shadow card" : "lamp off");
    }
    if (card) {
      other.shadow_card = true;
    } else {
      other.lamp = LampState::kOff;
    }
    out.push_back(std::move(other));
    return {};
  }
  if (part.ends_with("deg") || part.ends_with("°")) {
    const auto angle = ParseAngle(part);
    if (!angle) return tl::unexpected(angle.error());
    if (!(std::abs(angle->value()) < RadiansFromDegrees(180.0).value())) {
      return Refused("bad_reading", part, "an angle off the axis lies within 180 degrees");
    }
    if (std::exchange(angle_given, true)) return GivenTwice(part, "angle off the axis");
    for (Reading& one : out) one.off_axis = *angle;
    return {};
  }
  if (!part.empty() && (part.back() == 'K' || part.back() == 'k')) {
    const auto cct = ParseLampTemperature(part);
    if (!cct) return tl::unexpected(cct.error());
    if (out.front().cct) return GivenTwice(part, "colour temperature");
    out.front().cct = *cct;
    return {};
  }
  return WrongUsage(
      part, std::string(kForm) +
                "; after a comma stand card=LUX (behind a shadow card), off=LUX (the "
                "lamp off), an angle off the axis such as 15deg or a colour temperature such "
                "as 2900K; decimals have a point");
}

}  // namespace

std::vector<std::string> SplitAt(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t at = text.find(separator);
    parts.emplace_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

Result<std::vector<Reading>> ParseTypedReading(const std::string& text, const std::string& light) {
  const std::vector<std::string> parts = SplitAt(text, ',');
  const std::string& first = parts.front();
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    if (WithinNumber(parts, i)) return DecimalComma(parts, text);
  }
  const auto at = first.find('@');
  if (at == std::string::npos) return WrongUsage(text, MeantWithoutDistance(text) + kForm);
  const Result<Lux> illuminance = NotNegative(first.substr(0, at));
  if (!illuminance) return tl::unexpected(illuminance.error());
  const auto distance = ParseLength(first.substr(at + 1));
  if (!distance) return tl::unexpected(distance.error());
  std::vector<Reading> out(1);
  out.front().light = light;
  out.front().illuminance = *illuminance;
  out.front().distance = *distance;
  const Reading lit = out.front();
  bool angle_given = false;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    auto added = AddPart(parts[i], lit, angle_given, out);
    if (!added) return Propagate(std::move(added));
  }
  if (distance->value() > kFarthestMetres) {
    return Refused("bad_reading", text, "no meter stands so far away; look at the distance's unit");
  }
  if (distance->value() <= 0.0) {
    return Refused("bad_reading", text, "the distance must be above zero");
  }
  return out;
}

Result<std::vector<double>> ParseLengths(const std::string& option, const std::string& text,
                                         char separator) {
  std::vector<std::string> parts = SplitAt(text, separator);
  for (std::string& part : parts) part = TrimBlanks(part);
  const auto last = SplitNumberAndUnit(parts.back());
  std::vector<double> out;
  for (std::string part : parts) {
    if (last && ParseNumber(part)) {
      if (last->unit.find_first_of("0123456789") !=
          std::string_view::npos) {  // "20x1ft8in": of feet, of inches, of metres?
        return WrongUsage(option, "\"" + text + "\": write the unit of " + part + " too");
      }
      part += std::string(last->unit);
    }
    const auto length = ParseLength(part);
    if (!length) return WrongUsage(option, "\"" + text + "\": " + length.error().message);
    out.push_back(length->value());
  }
  return out;
}

Result<std::vector<double>> ParseSides(const std::string& text, std::size_t count,
                                       const std::string& example) {
  if (text.empty()) return std::vector<double>();
  const char separator = text.find(',') == std::string::npos ? 'x' : ',';
  auto sides = ParseLengths("\"" + text + "\"", text, separator);
  const bool positive = sides && std::ranges::all_of(*sides, [](double v) { return v > 0.0; });
  if (positive && sides->size() == count) return sides;
  return WrongUsage("\"" + text + "\"", "is not " + example);
}

Result<Kelvin> ParseLampTemperature(const std::string& text) {
  auto cct = ParseTemperature(text);
  if (cct && !(cct->value() > 0.0)) return WrongUsage(text, "must be above zero");
  if (cct && !(*cct >= kColdestLamp)) {
    return Refused("bad_reading", text,
                   "no lamp is so red: a candle has 1900 K; is a digit missing?");
  }
  if (cct && !IsTemperatureOfLamp(*cct)) {
    return Refused("bad_reading", text,
                   "no lamp is so blue: the sky has 20 000 K; is there a digit too many?");
  }
  return cct;
}

Result<double> ParseDuv(const std::string& text) {
  constexpr double kFarthestLamp = 0.1;
  const auto duv = ParseNumber(text);
  if (!duv) return WrongUsage(text, "Duv is a number such as 0.004 or -0.002");
  if (!(std::abs(*duv) <= kFarthestLamp)) {
    return Refused("bad_reading", text, "no lamp is so green or pink: Duv is a few thousandths");
  }
  return *duv;
}

Result<void> SetRoom(const std::string& text, Session& session) {
  constexpr const char* kRoomForm =
      "a room is written LENGTH,WIDTH,HEIGHT in metres, for example 5,4,2.6 (and ,0.7 for its "
      "reflectance), or dark, or outdoors";
  if (text == "dark" || text == "outdoors") {
    session.surroundings = text == "dark" ? Surroundings::kDark : Surroundings::kOutdoors;
    return {};
  }
  const std::vector<std::string> parts = SplitAt(text, ',');
  if (parts.size() != 3 && parts.size() != 4) return WrongUsage(text, kRoomForm);
  const auto sides = ParseLengths(text, parts[0] + "," + parts[1] + "," + parts[2], ',');
  const bool positive = sides && std::ranges::all_of(*sides, [](double v) { return v > 0.0; });
  if (!positive) return WrongUsage(text, kRoomForm);
  Room room;
  std::ranges::copy(*sides, room.size_m.begin());
  if (parts.size() == 4) {
    const auto reflectance = SplitNumberAndUnit(parts[3]);
    if (!reflectance || !reflectance->unit.empty() || !(reflectance->number >= 0.0) ||
        !(reflectance->number < 1.0)) {
      return WrongUsage(text, std::string("a reflectance lies from 0 to below 1; ") + kRoomForm);
    }
    room.reflectance = reflectance->number;
  }
  session.room = room;
  return {};
}

Result<double> SigmaOfMeter(const std::string& text) {
  constexpr std::array<std::pair<std::string_view, double>, 3> kClasses = {
      {{"phone", 0.25}, {"hobby", 0.05}, {"lab", 0.02}}};
  for (const auto& [name, figure] : kClasses) {
    if (text == name) return figure / kZ95;
  }
  if (!text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0) {
    return WrongUsage(text, "a meter is phone, hobby or lab, or its maker's figure, e.g. 3%");
  }
  return ParseTolerance(text).map([](double figure) { return figure / kZ95; });
}

}  // namespace lightcal::app
