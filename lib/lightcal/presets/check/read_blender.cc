// SPDX-License-Identifier: Apache-2.0
// The preset inside a <stem>.blender.py, by what Cycles makes of its numbers.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>

#include "lightcal/presets/check/json_reader_parts.h"
#include "lightcal/presets/check/whole_text.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

using Json = nlohmann::json;

EngineLight FromBlender(const Json& json, double lumens_per_watt, const std::string& space) {
  EngineLight light;
  light.name = json.at("name").get<std::string>();
  const std::string type = json.at("type").get<std::string>();
  const Vec3 color = VecFrom(json.at("color"));
  const double y = LuminanceOfSpace(space, color);
  if (!json.contains("picture")) light.rgb = Rec709OfSpace(space, color);
  light.offset_m = OffsetIn(json.value("measured", Json()));
  if (type == "WORLD") {
    light.kind = EngineLightKind::kDome;
    light.emitted = json.at("strength").get<double>() * lumens_per_watt * y;
    // Of a picture, what it brings from above.
    if (json.contains("picture")) {
      light.emitted *= json.at("upward_lx").get<double>() / std::numbers::pi;
    }
    return light;
  }
  const double watts = json.at("energy_W").get<double>() * y;
  const Vec3 x = VecFrom(json.at("axes").at(0));
  const Vec3 up = VecFrom(json.at("axes").at(1));
  light.aim = VecFrom(json.at("axes").at(2)) * -1.0;
  light.position_m = VecFrom(json.at("position_m"));
  light.x = x;
  light.y = up;
  light.emitted = watts * lumens_per_watt / (4.0 * std::numbers::pi);
  if (type == "SUN") {
    light.kind = EngineLightKind::kSun;
    light.emitted = watts * lumens_per_watt;
  } else if (type == "AREA") {
    light.kind = EngineLightKind::kFlat;
    light.round = json.at("shape").get<std::string>() == "DISK";
    light.width_m = json.at("size_m").at(0).get<double>();
    light.height_m = light.round ? light.width_m : json.at("size_m").at(1).get<double>();
    const double area =
        light.width_m * light.height_m * (light.round ? std::numbers::pi / 4.0 : 1.0);
    light.emitted = watts * lumens_per_watt / (std::numbers::pi * area);
  } else if (type == "SPOT") {
    light.kind = EngineLightKind::kSpot;
    light.law = ConeLaw::kSmooth;
    light.outer_rad = json.at("spot_size_rad").get<double>() / 2.0;
    const double edge = std::cos(light.outer_rad);
    light.inner_rad = std::acos(edge + json.at("spot_blend").get<double>() * (1.0 - edge));
  } else if (type == "IES") {
    TakeTable(light, json.at("ies").get<std::string>());
    light.emitted = watts * lumens_per_watt / 177.83;
    light.x = up * -1.0;  // C0 of the node is -y, its C90 is -x
    light.y = x * -1.0;
  }
  return light;
}

// The script runs itself with its last statement; without it nothing comes into the scene.
void RequireItsCall(std::string_view text) {
  const std::size_t guard = std::min(text.rfind("__main__"), text.size());
  if (text.substr(guard).find("run(") == std::string_view::npos) {
    ThrowCutOff("the call of run() that ends the script");
  }
  RequireClosed(text, kPythonSyntax);
}

}  // namespace

std::vector<EngineLight> ReadBlender(const std::string& text, const FileText& /*beside*/) {
  RequireItsCall(text);
  const Json root = Json::parse(ObjectFrom(text, text.find("json.loads(r'''")));
  std::vector<EngineLight> lights;
  for (const Json& json : root.at("lights")) {
    lights.push_back(FromBlender(json, root.at("lumens_per_watt").get<double>(),
                                 root.value("color_space", std::string())));
  }
  return lights;
}

}  // namespace lightcal
