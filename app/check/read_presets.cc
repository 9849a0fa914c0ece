// SPDX-License-Identifier: Apache-2.0
// Preset files read back by what their formats mean, not by what the exporters did.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "check/engine_light.h"
#include "check/read_scenes.h"
#include "output_files.h"
#include "srgb.h"

namespace lightcal::app {
namespace {

using Json = nlohmann::json;
constexpr double kPi = 3.14159265358979323846;

Vec3 Vec(const Json& v) {
  return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}
double Luma(const Json& rgb) { return Rec709Luminance(Vec(rgb)); }
Vec3 Negative(const Vec3& v) { return {-v[0], -v[1], -v[2]}; }

double OffsetIn(const Json& extras) {
  if (!extras.is_object() || !extras.contains("distance_offset_m")) return 0.0;
  return extras.at("distance_offset_m").at("value").get<double>();
}

// The {...} that starts at or after `from`, by its braces.
std::string Object(const std::string& text, std::size_t from) {
  const std::size_t start = text.find('{', from);
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = start; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
      continue;
    }
    if (c == '"') quoted = true;
    if (c == '{') ++depth;
    if (c == '}' && --depth == 0) return text.substr(start, i - start + 1);
  }
  return {};
}

// ---- glTF ----

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
  if (definition.contains("color")) light.emitted *= Luma(definition["color"]);
  light.range_m = definition.value("range", 0.0);
  const std::string type = definition.at("type").get<std::string>();
  light.kind = type == "spot"          ? EngineLightKind::kSpot
               : type == "directional" ? EngineLightKind::kSun
                                       : EngineLightKind::kPoint;
  if (type == "spot") {
    const Json spot = definition.value("spot", Json::object());
    light.inner_rad = spot.value("innerConeAngle", 0.0);
    light.outer_rad = spot.value("outerConeAngle", kPi / 4.0);
  }
  if (node.contains("translation")) light.position_m = Stood(Vec(node["translation"]));
  const Vec3 ahead = {0.0, 0.0, -1.0};
  light.aim = Stood(node.contains("rotation") ? Rotated(node["rotation"], ahead) : ahead);
  if (node.contains("extras")) light.offset_m = OffsetIn(node["extras"].value("lightcal", Json()));
  return light;
}

std::vector<EngineLight> Gltf(const Json& root) {
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

// ---- Blender ----

EngineLight FromBlender(const Json& json, double lumens_per_watt) {
  EngineLight light;
  light.name = json.at("name").get<std::string>();
  const std::string type = json.at("type").get<std::string>();
  const double y = Luma(json.at("color"));
  light.offset_m = OffsetIn(json.value("measured", Json()));
  if (type == "WORLD") {
    light.kind = EngineLightKind::kDome;
    light.emitted = json.at("strength").get<double>() * lumens_per_watt * y;
    return light;
  }
  const double watts = json.at("energy_W").get<double>() * y;
  const Vec3 x = Vec(json.at("axes").at(0));
  const Vec3 up = Vec(json.at("axes").at(1));
  light.aim = Negative(Vec(json.at("axes").at(2)));
  light.position_m = Vec(json.at("position_m"));
  light.x = x;
  light.y = up;
  light.emitted = watts * lumens_per_watt / (4.0 * kPi);
  if (type == "SUN") {
    light.kind = EngineLightKind::kSun;
    light.emitted = watts * lumens_per_watt;
  } else if (type == "AREA") {
    light.kind = EngineLightKind::kFlat;
    light.round = json.at("shape").get<std::string>() == "DISK";
    light.width_m = json.at("size_m").at(0).get<double>();
    light.height_m = light.round ? light.width_m : json.at("size_m").at(1).get<double>();
    const double area = light.width_m * light.height_m * (light.round ? kPi / 4.0 : 1.0);
    light.emitted = watts * lumens_per_watt / (kPi * area);
  } else if (type == "SPOT") {
    light.kind = EngineLightKind::kSpot;
    light.law = ConeLaw::kSmooth;
    light.outer_rad = json.at("spot_size_rad").get<double>() / 2.0;
    const double edge = std::cos(light.outer_rad);
    light.inner_rad = std::acos(edge + json.at("spot_blend").get<double>() * (1.0 - edge));
  } else if (type == "IES") {
    TakeTable(light, json.at("ies").get<std::string>());
    light.emitted = watts * lumens_per_watt / 177.83;
    light.x = Negative(up);  // C0 of the node is -y, its C90 is -x
    light.y = Negative(x);
  }
  return light;
}

// ---- three.js ----

EngineLight FromThree(const Json& json) {
  EngineLight light;
  light.name = json.at("name").get<std::string>();
  const std::string type = json.at("type").get<std::string>();
  light.emitted = json.at("intensity").get<double>() * Luma(json.at("color"));
  light.position_m = Stood(Vec(json.at("position_m")));
  light.aim = Stood(Vec(json.at("direction")));
  light.offset_m = OffsetIn(json.value("measured", Json()));
  if (type == "directional") light.kind = EngineLightKind::kSun;
  if (type == "dome") light.kind = EngineLightKind::kDome;
  if (type == "spot") {
    light.kind = EngineLightKind::kSpot;
    light.law = ConeLaw::kSmooth;
    light.inner_rad = json.at("inner_rad").get<double>();
    light.outer_rad = json.at("outer_rad").get<double>();
  }
  if (type == "rect") {
    light.kind = EngineLightKind::kFlat;
    light.x = Stood(Vec(json.at("axes").at(0)));
    light.y = Stood(Vec(json.at("axes").at(1)));
    light.width_m = json.at("width_m").get<double>();
    light.height_m = json.at("height_m").get<double>();
  }
  if (type == "ies") {
    TakeTable(light, json.at("ies").get<std::string>());
    light.emitted /= light.table->peak().intensity.value();  // the loader makes the peak 1
    // Round about its aim; any frame will do for an axial table.
    light.x = {light.aim[2], light.aim[0], light.aim[1]};
    light.x = Cross(light.x, light.aim);
    light.x = light.x * (1.0 / Length(light.x));
    light.y = Cross(light.x, light.aim);
  }
  return light;
}

// ---- Filament ----

EngineLight FromFilament(const Json& json) {
  EngineLight light;
  light.name = json.at("name").get<std::string>();
  const std::string type = json.at("type").get<std::string>();
  const double y = Luma(json.at("color"));
  light.offset_m = OffsetIn(json.value("measured", Json()));
  if (type == "INDIRECT") {
    light.kind = EngineLightKind::kDome;
    light.emitted = json.at("intensity").get<double>() * y;
    return light;
  }
  light.position_m = Stood(Vec(json.at("position_m")));
  light.aim = Stood(Vec(json.at("direction")));
  if (type == "SUN" || type == "DIRECTIONAL") {
    light.kind = EngineLightKind::kSun;
    light.emitted = json.at("intensity_lx").get<double>() * y;
    return light;
  }
  light.emitted = json.at("intensity_candela").get<double>() * y;
  light.range_m = json.at("falloff_m").get<double>();
  if (type == "FOCUSED_SPOT") {
    light.kind = EngineLightKind::kSpot;
    light.inner_rad = json.at("inner_rad").get<double>();
    light.outer_rad = json.at("outer_rad").get<double>();
  }
  return light;
}

// ---- lightcal.preset/1 ----

EngineLight FromPreset(const Json& json) {
  EngineLight light;
  light.name = json.at("name").get<std::string>();
  const std::string kind = json.at("kind").get<std::string>();
  const Json& photometry = json.at("photometry");
  const Json& geometry = json.at("geometry");
  const auto value = [&](const char* key) { return photometry.at(key).at("value").get<double>(); };
  if (geometry.contains("position_m")) light.position_m = Vec(geometry["position_m"]);
  const bool aimed = geometry.contains("aim");
  if (aimed) light.aim = Vec(geometry["aim"]);
  if (kind == "directional") {
    light.kind = EngineLightKind::kSun;
    light.emitted = value("illuminance_lx");
    return light;
  }
  if (kind == "dome") {
    light.kind = EngineLightKind::kDome;
    light.emitted = photometry.contains("luminance_nits") ? value("luminance_nits")
                                                          : value("illuminance_lx") / kPi;
    return light;
  }
  light.emitted = value("intensity_cd");
  const double offset = OffsetIn(photometry);
  const bool faces =
      aimed || kind == "spot" || kind == "rect" || kind == "disk" || kind == "photometric";
  if (faces) {
    light.position_m = light.position_m - light.aim * offset;
  } else {
    light.offset_m = offset;
  }
  if (kind == "spot" && geometry.contains("outer_deg")) {
    light.kind = EngineLightKind::kSpot;
    light.outer_rad = geometry["outer_deg"].get<double>() * kPi / 180.0;
    light.inner_rad = geometry.value("inner_deg", 0.0) * kPi / 180.0;
  }
  return light;
}

// ---- by name ----

Json Parsed(const std::string& text) { return Json::parse(text); }

std::vector<EngineLight> Each(const Json& root, EngineLight (*read)(const Json&)) {
  std::vector<EngineLight> lights;
  for (const Json& json : root.at("lights")) lights.push_back(read(json));
  return lights;
}

// Reads a file that a preset names, in its own directory only.
FileText Beside(const std::string& path) {
  return [folder = std::filesystem::path(path).parent_path()](const std::string& name) {
    const std::filesystem::path file(name);
    if (file.filename() != file.lexically_normal()) {
      throw std::runtime_error(name + " does not stand beside it");
    }
    auto text = ReadWholeFile((folder / file).string());
    if (!text) throw std::runtime_error(name + " " + text.error().message);
    return *std::move(text);
  };
}

std::vector<EngineLight> Read(const std::string& path, const std::string& text) {
  if (path.ends_with(".gltf")) return Gltf(Parsed(text));
  if (path.ends_with(".filament.json")) return Each(Parsed(text), &FromFilament);
  if (path.ends_with(".preset.json")) return Each(Parsed(text), &FromPreset);
  if (path.ends_with(".three.js")) {
    return Each(Parsed(Object(text, text.find("export const preset"))), &FromThree);
  }
  if (path.ends_with(".blender.py")) {
    const Json root = Parsed(Object(text, text.find("json.loads(r'''")));
    std::vector<EngineLight> lights;
    for (const Json& json : root.at("lights")) {
      lights.push_back(FromBlender(json, root.at("lumens_per_watt").get<double>()));
    }
    return lights;
  }
  if (path.ends_with(".tscn")) return LightsOfGodotScene(text);
  if (path.ends_with(".usda")) return LightsOfUsda(text, Beside(path));
  EngineLight light;
  TakeTable(light, text);
  light.emitted = 1.0;
  light.placed = false;
  return {light};
}

}  // namespace

Result<std::vector<EngineLight>> LightsOfPreset(const std::string& path, const std::string& text) {
  constexpr std::string_view kEndings[] = {".gltf",          ".blender.py",  ".three.js",
                                           ".filament.json", ".preset.json", ".tscn",
                                           ".usda",          ".ies",         ".ldt"};
  if (std::ranges::none_of(kEndings, [&](std::string_view end) { return path.ends_with(end); })) {
    return WrongUsage(path,
                      "is none of .gltf, .blender.py, .three.js, .filament.json, .preset.json, "
                      ".tscn, .usda, .ies, .ldt");
  }
  try {
    auto lights = Read(path, text);
    if (lights.empty()) return Refused("bad_preset", path, "holds no light");
    RequireFinite(lights);
    return lights;
  } catch (const std::exception& error) {
    return Refused("bad_preset", path,
                   std::string("is not as lightcal writes it: ") + error.what());
  }
}

}  // namespace lightcal::app
