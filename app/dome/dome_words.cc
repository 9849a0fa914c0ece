// SPDX-License-Identifier: Apache-2.0
#include "dome/dome_words.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "picture_words.h"

namespace lightcal::app {
namespace {

// Absent where anything between the commas is no number.
std::optional<std::vector<double>> NumbersBetweenCommas(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const auto number = ParseNumber(TrimBlanks(text.substr(0, comma)));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    if (comma == text.size()) return numbers;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace

Result<Vec3> ParseDirection(const std::string& option, const std::string& text) {
  if (text == "up") return Vec3{0.0, 0.0, 1.0};
  if (text == "down") return Vec3{0.0, 0.0, -1.0};
  const auto degrees = NumbersBetweenCommas(text);
  if (!degrees || degrees->size() != 2 || std::abs((*degrees)[1]) > 90.0) {
    return WrongUsage(option, "\"" + text +
                                  "\" is neither up, down nor AZIMUTH,ELEVATION in degrees (right "
                                  "of the picture's centre, above the horizon)");
  }
  const double a = RadiansFromDegrees((*degrees)[0]).value();
  const double e = RadiansFromDegrees((*degrees)[1]).value();
  return Vec3{std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
}

Result<ViewAim> ParseAim(const std::string& option, const std::string& text) {
  auto degrees = NumbersBetweenCommas(text);
  const bool fits = degrees && (degrees->size() == 2 || degrees->size() == 3);
  if (!fits || std::abs((*degrees)[1]) > 90.0) {
    return WrongUsage(option, "\"" + text +
                                  "\" is not YAW,PITCH[,ROLL] in degrees (right of +Y, above the "
                                  "horizon, leaning right), such as 45,0 or 0,90");
  }
  degrees->resize(3);
  return ViewAim{RadiansFromDegrees((*degrees)[0]), RadiansFromDegrees((*degrees)[1]),
                 RadiansFromDegrees((*degrees)[2])};
}

Result<LevelView> ParseLevel(const std::string& option, const std::string& text) {
  LevelView level;
  const std::size_t comma = text.find(',');
  level.file = text.substr(0, comma);
  auto degrees = comma == std::string::npos
                     ? std::optional(std::vector<double>())
                     : NumbersBetweenCommas(std::string_view(text).substr(comma + 1));
  if (degrees && degrees->size() <= 2) degrees->resize(2);
  if (level.file.empty() || !degrees || degrees->size() > 2 || std::abs((*degrees)[0]) > 90.0) {
    return WrongUsage(option, "\"" + text +
                                  "\" is not VIEW[,PITCH[,ROLL]]: a view that stood level, by its "
                                  "file or its number from 1, or its pitch and roll in degrees");
  }
  level.pitch = RadiansFromDegrees((*degrees)[0]);
  level.roll = RadiansFromDegrees((*degrees)[1]);
  return level;
}

Result<std::array<double, 4>> ParsePixelBox(const std::string& option, const std::string& text) {
  const auto numbers = NumbersBetweenCommas(text);
  if (!numbers || numbers->size() != 4 || !((*numbers)[2] > 0.0 && (*numbers)[3] > 0.0)) {
    return WrongUsage(
        option, "\"" + text + "\" is not X,Y,WIDTH,HEIGHT in pixels, such as 812,430,310,310");
  }
  return std::array{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
}

Result<std::array<double, 2>> ParseReflectance(const std::string& option, const std::string& text) {
  const auto numbers = NumbersBetweenCommas(text);
  const bool fits = numbers && !numbers->empty() && numbers->size() <= 2 && (*numbers)[0] > 0.0 &&
                    (*numbers)[0] <= 1.0 && numbers->back() >= 0.0;
  if (!fits) {
    return WrongUsage(option, "\"" + text +
                                  "\" is not a reflectance above 0 and up to 1, such as "
                                  "0.62 or 0.62,0.05 (1 sigma)");
  }
  return std::array{(*numbers)[0], numbers->size() == 2 ? (*numbers)[1] : 0.0};
}

Result<CameraSettings> ParsePlateExposure(const std::string& option, const std::string& text) {
  std::array<std::string_view, 3> parts;
  std::string_view rest = text;
  std::size_t count = 0;
  while (count < parts.size()) {
    const std::size_t comma = rest.find(',');
    parts[count++] = TrimBlanks(rest.substr(0, comma));
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  const bool whole = count == 3 && rest.find(',') == std::string_view::npos;
  const auto f_number = ParseFNumber(parts[0]);
  const auto time = ParseDuration(parts[1]);
  const auto iso = ParseNumber(parts[2]);
  if (!whole || !f_number || !time || !iso) {
    return WrongUsage(option, "\"" + text + "\" is not f-number,time,ISO such as f/8,1/60,100");
  }
  const CameraSettings camera{*f_number, *time, *iso};
  if (!IsPossible(camera)) {
    return Refused("not_positive", option, "f-number, time and ISO speed are above 0");
  }
  return camera;
}

}  // namespace lightcal::app
