// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 with KHR_lights_punctual, by its specification.
#include <nlohmann/json.hpp>
#include <numbers>

#include "lightcal/presets/check/json_reader_parts.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

using Json = nlohmann::json;

Vec3 Rotated(const Json& q, const Vec3& v) {
  const Vec3 axis = {q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>()};
  const double w = q.at(3).get<double>();
  const Vec3 twice = Cross(axis, v) * 2.0;
  return v + twice * w + Cross(axis, twice);
}

EngineLight FromGltf(const Json& node, const Json& definition) {
  EngineLight light;
  light.name = node.value("name", definition.value("name", std::string()));
  light.emitted = definition.value("intensity", 1.0);
  if (definition.contains("color")) light.emitted *= LuminanceFrom(definition["color"]);
  light.range_m = definition.value("range", 0.0);
  light.window_power = 1.0;
  const std::string type = definition.at("type").get<std::string>();
  light.kind = type == "spot"          ? EngineLightKind::kSpot
               : type == "directional" ? EngineLightKind::kSun
                                       : EngineLightKind::kPoint;
  if (type == "spot") {
    const Json spot = definition.value("spot", Json::object());
    light.inner_rad = spot.value("innerConeAngle", 0.0);
    light.outer_rad = spot.value("outerConeAngle", std::numbers::pi / 4.0);
  }
  if (node.contains("translation")) light.position_m = FromYUp(VecFrom(node["translation"]));
  const Vec3 ahead = {0.0, 0.0, -1.0};
  light.aim = FromYUp(node.contains("rotation") ? Rotated(node["rotation"], ahead) : ahead);
  if (node.contains("extras")) light.offset_m = OffsetIn(node["extras"].value("lightcal", Json()));
  return light;
}

}  // namespace

std::vector<EngineLight> ReadGltf(const std::string& text, const FileText& /*beside*/) {
  const Json root = Json::parse(text);
  std::vector<EngineLight> lights;
  const Json& list = root.at("extensions").at("KHR_lights_punctual").at("lights");
  for (const Json& node : root.at("nodes")) {
    if (!node.contains("extensions") || !node["extensions"].contains("KHR_lights_punctual"))
      continue;
    const auto index = node["extensions"]["KHR_lights_punctual"].at("light").get<std::size_t>();
    lights.push_back(FromGltf(node, list.at(index)));
  }
  return lights;
}

}  // namespace lightcal
