// SPDX-License-Identifier: Apache-2.0
#include "simulate/lamp_places.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"

namespace lightcal::app {
namespace {

using Parse = Result<Vec3> (*)(const std::string& option, const std::string& text);

template <class ParseOne>
Result<Vec3> ParseThree(const std::string& option, const std::string& text, const ParseOne& parse) {
  Vec3 out{};
  std::string_view rest = text;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = axis < 2 ? rest.find(',') : rest.size();
    if (comma == std::string_view::npos) {
      return WrongUsage(option, "\"" + text + "\" must be three numbers: x,y,z");
    }
    const auto value = parse(TrimBlanks(rest.substr(0, comma)));
    if (!value) return WrongUsage(option, "\"" + text + "\" must be three numbers: x,y,z");
    out[axis] = *value;
    rest.remove_prefix(std::min(rest.size(), comma + 1));
  }
  return out;
}

Result<LampPlaces::ByLight> ParsePlaces(const std::string& option,
                                        const std::vector<std::string>& texts,
                                        const std::vector<const FittedLight*>& lights,
                                        Parse parse) {
  LampPlaces::ByLight out;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    std::string name = equals == std::string::npos ? "" : text.substr(0, equals);
    if (name.empty() && lights.size() > 1) {
      return WrongUsage(option, "there are several lights; say which: " + option + " " +
                                    lights.front()->name + "=" + text);
    }
    if (name.empty()) name = lights.front()->name;
    const bool known = std::ranges::any_of(lights, [&](const auto* l) { return l->name == name; });
    if (!known) return WrongUsage(option, "no light \"" + name + "\" is simulated");
    const auto value = parse(option, equals == std::string::npos ? text : text.substr(equals + 1));
    if (!value) return tl::unexpected(value.error());
    out[name] = *value;
  }
  return out;
}

}  // namespace

Result<Vec3> ParsePoint(const std::string& option, const std::string& text) {
  return ParseThree(option, text, [](std::string_view one) -> std::optional<double> {
    const auto length = ParseLength(one);
    if (!length) return std::nullopt;
    return length->value();
  });
}

Result<Vec3> ParseUnitVector(const std::string& option, const std::string& text) {
  auto direction = ParseThree(option, text, [](std::string_view one) { return ParseNumber(one); });
  if (!direction) return direction;
  const double length = Length(*direction);
  if (!(length > 0.0)) return WrongUsage(option, "\"" + text + "\" has no direction");
  return *direction * (1.0 / length);
}

Result<std::optional<Vec3>> ParseMeterNormal(const std::string& text) {
  if (text == "lamp") return std::optional<Vec3>();
  if (text == "up") return std::optional<Vec3>(Vec3{0.0, 0.0, 1.0});
  const auto stated = ParseUnitVector("--normal", text);
  if (!stated) return tl::unexpected(stated.error());
  return std::optional<Vec3>(*stated);
}

Result<LampPlaces> ParseLampPlaces(const LampPlaceWords& words,
                                   const std::vector<const FittedLight*>& lights) {
  LampPlaces places;
  auto position = ParsePlaces("--position", words.position, lights, ParsePoint);
  if (!position) return Propagate(std::move(position));
  places.position_m = *std::move(position);
  auto aim = ParsePlaces("--aim", words.aim, lights, ParseUnitVector);
  if (!aim) return Propagate(std::move(aim));
  places.aim = *std::move(aim);
  auto axis = ParsePlaces("--axis", words.axis, lights, ParseUnitVector);
  if (!axis) return Propagate(std::move(axis));
  places.axis = *std::move(axis);
  return places;
}

}  // namespace lightcal::app
