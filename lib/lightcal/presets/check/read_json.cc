// SPDX-License-Identifier: Apache-2.0
// A <stem>.preset.json, schema lightcal.preset/1: the measured lights themselves.
#include <nlohmann/json.hpp>
#include <numbers>

#include "lightcal/presets/check/json_reader_parts.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

using Json = nlohmann::json;

EngineLight FromPreset(const Json& json) {
  EngineLight light;
  light.name = json.at("name").get<std::string>();
  const std::string kind = json.at("kind").get<std::string>();
  const Json& photometry = json.at("photometry");
  const Json& geometry = json.at("geometry");
  const auto value = [&](const char* key) { return photometry.at(key).at("value").get<double>(); };
  if (geometry.contains("position_m")) light.position_m = VecFrom(geometry["position_m"]);
  const bool aimed = geometry.contains("aim");
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
  if (kind == "spot" && geometry.contains("outer_deg")) {
    light.kind = EngineLightKind::kSpot;
    light.outer_rad = geometry["outer_deg"].get<double>() * std::numbers::pi / 180.0;
    light.inner_rad = geometry.value("inner_deg", 0.0) * std::numbers::pi / 180.0;
  }
  return light;
}

}  // namespace

std::vector<EngineLight> ReadJson(const std::string& text, const FileText& /*beside*/) {
  return EachLight(Json::parse(text), &FromPreset);
}

}  // namespace lightcal
