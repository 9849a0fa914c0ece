// SPDX-License-Identifier: Apache-2.0
// A <stem>.preset.json, schema lightcal.preset/1: the measured lights themselves.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "lightcal/core/units.h"
#include "lightcal/light/lamp_axes.h"
#include "lightcal/presets/check/json_reader_parts.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

using Json = nlohmann::json;

// The lamp's own axes: a width or a length along "axis", else level, to the right as seen from
// behind the lamp.
void TakeAxes(const Json& geometry, EngineLight& light) {
  const Vec3 along = geometry.contains("axis") ? VecFrom(geometry["axis"]) : Vec3{};
  if (!geometry.contains("aim") && Length(along) > 0.0) {
    light.aim = AxesOfAim(along).c0;  // a tube shines to its side
  }
  light.aim = light.aim * (1.0 / Above0(light.name + ": the length of its aim", Length(light.aim)));
  const LampAxes axes = AxesOfAim(light.aim, along);
  light.x = axes.c0;
  light.y = axes.c90;
}

// A luminous face or mantle of that intensity. Without a size so small that none is seen.
void TakeSurface(const std::string& kind, const Json& geometry, EngineLight& light) {
  constexpr double kNoSize_m = 1e-3;
  const auto length = [&](const char* key) { return geometry.value(key, kNoSize_m); };
  light.round = kind == "disk";
  if (kind == "tube") {
    light.kind = EngineLightKind::kTube;
    light.width_m = length("length_m");
    light.height_m = 2.0 * length("radius_m");
  } else {
    light.kind = EngineLightKind::kFlat;
    light.width_m = length(light.round ? "diameter_m" : "width_m");
    light.height_m = light.round ? light.width_m : length("height_m");
  }
  const double share = light.round ? std::numbers::pi / 4.0 : 1.0;
  light.emitted /= Above0(light.name + ": its area", light.width_m * light.height_m * share);
}

// By the IES file beside it; false: there is none.
bool TakeDistribution(const Json& distribution, const FileText& beside, EngineLight& light) {
  const double peak_cd = light.emitted;
  if (distribution.contains("axial_cd")) {
    light.emitted *= distribution["axial_cd"].get<double>() /
                     Above0(light.name + ": peak_cd", distribution.at("peak_cd").get<double>());
  }
  std::string file;
  try {
    file = beside(distribution.value("ies_file", std::string()));
  } catch (const std::exception&) {
    return false;
  }
  TakeTable(light, file);
  light.emitted = peak_cd / light.table->peak().intensity.value();
  return true;
}

void TakeSpot(const Json& geometry, EngineLight& light) {
  light.kind = EngineLightKind::kSpot;
  light.outer_rad = geometry["outer_deg"].get<double>() * kRadiansPerDegree;
  light.inner_rad = geometry.value("inner_deg", 0.0) * kRadiansPerDegree;
}

EngineLight FromPreset(const Json& json, const FileText& beside) {
  EngineLight light;
  light.name = json.at("name").get<std::string>();
  const std::string kind = json.at("kind").get<std::string>();
  const Json& photometry = json.at("photometry");
  const Json& geometry = json.at("geometry");
  const auto value = [&](const char* key) { return photometry.at(key).at("value").get<double>(); };
  if (geometry.contains("position_m")) light.position_m = VecFrom(geometry["position_m"]);
  const bool aimed = geometry.contains("aim");
  if (const Json color = json.value("color", Json()); color.contains("rec709_linear")) {
    light.rgb = VecFrom(color["rec709_linear"].at("max_normalised"));
  }
  if (aimed) light.aim = VecFrom(geometry["aim"]);
  if (kind == "directional") {
    light.kind = EngineLightKind::kSun;
    light.emitted = value("illuminance_lx");
    return light;
  }
  if (kind == "dome") {
    light.kind = EngineLightKind::kDome;
    light.emitted = photometry.contains("luminance_nits")
                        ? value("luminance_nits")
                        : value("illuminance_lx") / std::numbers::pi;
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
  TakeAxes(geometry, light);
  const bool by_direction = kind == "spot" || kind == "photometric";
  if (kind == "rect" || kind == "disk" || kind == "tube") {
    TakeSurface(kind, geometry, light);
  } else if (by_direction && json.contains("distribution") &&
             TakeDistribution(json["distribution"], beside, light)) {
    return light;
  } else if (kind == "spot" && geometry.contains("outer_deg")) {
    TakeSpot(geometry, light);
  }
  return light;
}

}  // namespace

std::vector<EngineLight> ReadJson(const std::string& text, const FileText& beside) {
  std::vector<EngineLight> lights;
  const Json root = Json::parse(text);
  for (const Json& json : root.at("lights")) lights.push_back(FromPreset(json, beside));
  return lights;
}

}  // namespace lightcal
