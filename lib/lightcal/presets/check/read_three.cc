// SPDX-License-Identifier: Apache-2.0
// The preset inside a <stem>.three.js, by what three.js makes of its numbers.
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include "lightcal/presets/check/json_reader_parts.h"
#include "lightcal/presets/check/whole_text.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

using Json = nlohmann::json;

// A table of more than one plane (of a hand) is rolled by the shadow camera, which looks along the
// aim with three's y up: C0 to its left, C90 below.   Source: three.js 0.187, IESSpotLightNode,
// Matrix4.lookAt.
void LayTable(EngineLight& light) {
  const Vec3 right = Cross(light.aim, Vec3{0.0, 0.0, 1.0});
  const double sine = Length(right);
  constexpr double kUpright = 1e-6;
  light.x = sine > kUpright ? right * (-1.0 / sine) : Vec3{-1.0, 0.0, 0.0};
  light.y = Cross(light.x, light.aim);
}

EngineLight FromThree(const Json& json) {
  EngineLight light;
  light.name = json.at("name").get<std::string>();
  const std::string type = json.at("type").get<std::string>();
  const Vec3 color = VecFrom(json.at("color"));
  light.emitted = json.at("intensity").get<double>() * Rec709Luminance(color);
  if (!json.contains("picture")) light.rgb = color;
  light.position_m = FromYUp(VecFrom(json.at("position_m")));
  light.aim = FromYUp(VecFrom(json.at("direction")));
  light.offset_m = OffsetIn(json.value("measured", Json()));
  light.range_m = json.value("range_m", 0.0);
  if (type == "directional") light.kind = EngineLightKind::kSun;
  if (type == "dome") {
    light.kind = EngineLightKind::kDome;
    // Of a picture, what it brings from above.
    if (json.contains("picture")) {
      light.emitted = json.at("upward_lx").get<double>() / std::numbers::pi;
    }
  }
  if (type == "spot") {
    light.kind = EngineLightKind::kSpot;
    light.law = ConeLaw::kSmooth;
    const bool projected = json.contains("projected");
    if (projected) light.law = ConeLaw::kSquared;
    const Json& cone = !projected && json.contains("three") ? json.at("three") : json;
    light.inner_rad = cone.at("inner_rad").get<double>();
    light.outer_rad = cone.at("outer_rad").get<double>();
    if (json.contains("profile")) light.profile = json.at("profile").get<std::vector<double>>();
  }
  if (type == "rect") {
    light.kind = EngineLightKind::kFlat;
    light.x = FromYUp(VecFrom(json.at("axes").at(0)));
    light.y = FromYUp(VecFrom(json.at("axes").at(1)));
    light.width_m = json.at("width_m").get<double>();
    light.height_m = json.at("height_m").get<double>();
  }
  if (type == "ies") {
    TakeTable(light, json.at("ies").get<std::string>());
    light.emitted /= light.table->peak().intensity.value();  // the loader makes the peak 1
    LayTable(light);
  }
  return light;
}

// Functions follow the preset, and the last ends with its brace.
void RequireWhole(const std::string& text) {
  const std::size_t preset = text.find("export const preset");
  if (preset == std::string::npos) throw std::runtime_error("it exports no preset");
  RequireClosed(std::string_view(text).substr(preset), kJavaScriptSyntax);
  if (text.find("function buildThree") == std::string::npos) ThrowCutOff("buildThree()");
  if (!text.ends_with('\n') && !text.ends_with('}') && !text.ends_with(';')) {
    ThrowCutOff("the end of its last statement");
  }
}

}  // namespace

std::vector<EngineLight> ReadThree(const std::string& text, const FileText& /*beside*/) {
  RequireWhole(text);
  return EachLight(Json::parse(ObjectFrom(text, text.find("export const preset"))), &FromThree);
}

}  // namespace lightcal
