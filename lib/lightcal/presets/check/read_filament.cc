// SPDX-License-Identifier: Apache-2.0
// A <stem>.filament.json, by what Filament makes of its numbers.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "lightcal/presets/check/json_reader_parts.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

using Json = nlohmann::json;

// Its spots' cosine is a parabola of a parabola (fast.h, fast::cos): the angle it shows for one
// that is written.
double ShownAngle(double written) {
  const double s = 1.0 - 2.0 * written / std::numbers::pi;
  const double y = s * (2.0 - s);
  return std::acos(std::clamp(y * (0.775 + 0.225 * y), -1.0, 1.0));
}

EngineLight FromFilament(const Json& json) {
  EngineLight light;
  light.name = json.at("name").get<std::string>();
  const std::string type = json.at("type").get<std::string>();
  const Vec3 color = VecFrom(json.at("color"));
  const double y = Rec709Luminance(color);
  if (!json.contains("irradiance")) light.rgb = color;
  light.offset_m = OffsetIn(json.value("measured", Json()));
  if (type == "INDIRECT") {
    light.kind = EngineLightKind::kDome;
    light.emitted = json.at("intensity").get<double>() * y;
    if (json.contains("irradiance")) {
      light.emitted = json.at("upward_lx").get<double>() / std::numbers::pi;
    }
    return light;
  }
  light.position_m = FromYUp(VecFrom(json.at("position_m")));
  light.aim = FromYUp(VecFrom(json.at("direction")));
  if (type == "SUN" || type == "DIRECTIONAL") {
    light.kind = EngineLightKind::kSun;
    light.emitted = json.at("intensity_lx").get<double>() * y;
    return light;
  }
  light.emitted = json.at("intensity_candela").get<double>() * y;
  light.range_m = json.at("falloff_m").get<double>();
  if (type == "FOCUSED_SPOT") {
    light.kind = EngineLightKind::kSpot;
    light.inner_rad = ShownAngle(json.at("inner_rad").get<double>());
    light.outer_rad = ShownAngle(json.at("outer_rad").get<double>());
  }
  return light;
}

}  // namespace

std::vector<EngineLight> ReadFilament(const std::string& text, const FileText& /*beside*/) {
  return EachLight(Json::parse(text), &FromFilament);
}

}  // namespace lightcal
