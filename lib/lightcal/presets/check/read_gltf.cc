// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 with KHR_lights_punctual, by its specification.
#include <cstddef>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "lightcal/presets/check/json_reader_parts.h"
#include "lightcal/presets/check/scene_frame.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

using Json = nlohmann::json;

SceneFrame FrameOf(const Json& node) {
  if (node.contains("matrix")) {  // by columns
    const Json& m = node["matrix"];
    const auto column = [&](std::size_t at) {
      return Vec3{m.at(at).get<double>(), m.at(at + 1).get<double>(), m.at(at + 2).get<double>()};
    };
    return {column(0), column(4), column(8), column(12)};
  }
  SceneFrame frame;
  if (node.contains("rotation")) {
    const Json& q = node["rotation"];
    frame = FrameTurnedBy(VecFrom(q), q.at(3).get<double>());
  }
  if (node.contains("scale")) {
    const Vec3 scale = VecFrom(node["scale"]);
    frame.x = frame.x * scale[0];
    frame.y = frame.y * scale[1];
    frame.z = frame.z * scale[2];
  }
  if (node.contains("translation")) frame.origin = VecFrom(node["translation"]);
  return frame;
}

void Require(bool holds, const std::string& light, const char* what) {
  if (!holds) throw std::runtime_error(light + ": " + what);
}

// What KHR_lights_punctual allows; engines refuse or repair anything else, each in its own way.
void RequireLimits(const EngineLight& light, const Json& definition, const std::string& type) {
  const std::string& name = light.name;
  Require(type == "point" || type == "spot" || type == "directional", name,
          "its type is none of point, spot, directional");
  Require(definition.value("intensity", 1.0) >= 0.0, name, "its intensity is below 0");
  for (const double part : light.rgb.value_or(Vec3{})) {
    Require(part >= 0.0 && part <= 1.0, name, "its color has a component outside of 0 to 1");
  }
  Require(!definition.contains("range") || light.range_m > 0.0, name, "its range is not above 0");
  if (type != "spot") return;
  // A hair for numbers that were written with fewer digits.
  constexpr double kHalfTurn = std::numbers::pi / 2.0 + 1e-6;
  Require(light.inner_rad >= 0.0 && light.inner_rad < light.outer_rad, name,
          "its innerConeAngle is not from 0 to below its outerConeAngle");
  Require(light.outer_rad <= kHalfTurn, name,
          "its outerConeAngle is beyond pi/2: angles are radians from the axis");
}

// A scale moves what hangs below and makes no light brighter.
EngineLight FromGltf(const Json& node, const SceneFrame& frame, const Json& definition) {
  EngineLight light;
  light.name = node.value("name", definition.value("name", std::string()));
  light.emitted = definition.value("intensity", 1.0);
  light.rgb = definition.contains("color") ? VecFrom(definition["color"]) : Vec3{1.0, 1.0, 1.0};
  light.emitted *= Rec709Luminance(*light.rgb);
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
  RequireLimits(light, definition, type);
  light.position_m = FromYUp(frame.origin);
  light.aim = FromYUp(UnitAlong(light.name, frame.z)) * -1.0;
  if (node.contains("extras")) light.offset_m = OffsetIn(node["extras"].value("lightcal", Json()));
  return light;
}

// The lights of a scene, by its graph.
class SceneWalk {
 public:
  SceneWalk(const Json& root, std::vector<EngineLight>& lights)
      : nodes_(root.at("nodes")),
        definitions_(root.at("extensions").at("KHR_lights_punctual").at("lights")),
        seen_(nodes_.size()),
        lights_(lights) {}

  void Visit(std::size_t index, const SceneFrame& parent, std::size_t depth = 0) {
    if (depth > kDeepestNode) throw std::runtime_error("its nodes hang too deep");
    const Json& node = nodes_.at(index);
    if (seen_.at(index)) throw std::runtime_error("a node of it hangs at two places");
    seen_[index] = true;
    const Json extensions = node.value("extensions", Json::object());
    if (!extensions.value("KHR_node_visibility", Json::object()).value("visible", true)) return;
    const SceneFrame frame = Within(parent, FrameOf(node));
    if (extensions.contains("KHR_lights_punctual")) {
      const auto light = extensions["KHR_lights_punctual"].at("light").get<std::size_t>();
      lights_.push_back(FromGltf(node, frame, definitions_.at(light)));
    }
    for (const Json& child : node.value("children", Json::array())) {
      Visit(child.get<std::size_t>(), frame, depth + 1);
    }
  }

 private:
  const Json& nodes_;
  const Json& definitions_;
  std::vector<bool> seen_;
  std::vector<EngineLight>& lights_;
};

// Of the scene that is shown; of a file without scenes all nodes that hang below none.
std::vector<std::size_t> RootsOf(const Json& root) {
  if (root.contains("scenes")) {
    return root["scenes"]
        .at(root.value("scene", std::size_t{0}))
        .value("nodes", std::vector<std::size_t>());
  }
  const Json& nodes = root.at("nodes");
  std::vector<bool> below(nodes.size());
  for (const Json& node : nodes) {
    for (const Json& child : node.value("children", Json::array())) {
      below.at(child.get<std::size_t>()) = true;
    }
  }
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < below.size(); ++i) {
    if (!below[i]) roots.push_back(i);
  }
  return roots;
}

}  // namespace

std::vector<EngineLight> ReadGltf(const std::string& text, const FileText& /*beside*/) {
  const Json root = Json::parse(text);
  std::vector<EngineLight> lights;
  SceneWalk walk(root, lights);
  for (const std::size_t node : RootsOf(root)) walk.Visit(node, {});
  return lights;
}

}  // namespace lightcal
