// SPDX-License-Identifier: Apache-2.0
// UsdLux in a .usda, one attribute a line, by the schema's own words: luminance = intensity
// 2^exposure colour nits, over the area where normalize is on; matrices of row vectors. Of variants
// those that the file opens with.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units.h"
#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/check/usd_prims.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

std::string Unquoted(std::string_view text) {
  std::string out;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] == '\\') ++i;
    out += text[i];
  }
  return out;
}

// 2^exposure, colour and intensity together.
double LuminanceOf(const UsdPrim& prim) {
  if (prim.On("inputs:enableColorTemperature")) {
    throw std::runtime_error(prim.name + ": has a colour temperature on top of its colour");
  }
  const bool distant = prim.type == "DistantLight";
  double value = prim.Number("inputs:intensity", distant ? 50000.0 : 1.0) *
                 std::exp2(prim.Number("inputs:exposure", 0.0));
  if (const std::string& color = prim.Text("inputs:color"); !color.empty()) {
    const auto c = NumbersIn(color);
    if (c.size() != 3) throw std::runtime_error(prim.name + ": inputs:color has not three numbers");
    value *= LuminanceOfSpace(prim.space, {c[0], c[1], c[2]});
  }
  return value;
}

// White where nothing is said; of a picture it says nothing.
std::optional<Vec3> ColorOf(const UsdPrim& prim) {
  if (!prim.Text("inputs:texture:file").empty()) return std::nullopt;
  const auto c = NumbersIn(prim.Text("inputs:color"));
  if (c.size() != 3) return Vec3{1.0, 1.0, 1.0};
  return Rec709OfSpace(prim.space, {c[0], c[1], c[2]});
}

// Over the area where the light's power is normalised by it.
double UsdNits(const UsdPrim& prim, double area_m2) {
  if (!prim.On("inputs:normalize")) return LuminanceOf(prim);
  return LuminanceOf(prim) / Above0(prim.name + ": its area", area_m2);
}

void FromSphere(const UsdPrim& prim, const FileText& beside, EngineLight& light) {
  const double r = prim.Number("inputs:radius", 0.5);
  light.emitted = UsdNits(prim, 4.0 * std::numbers::pi * r * r) * std::numbers::pi * r * r;
  if (const std::string& file = prim.Text("inputs:shaping:ies:file"); !file.empty()) {
    std::string name = file.substr(1, file.size() - std::min<std::size_t>(file.size(), 2));
    if (name.starts_with("./")) name.erase(0, 2);
    TakeTable(light, beside(name));
    return;
  }
  const double outer = prim.Number("inputs:shaping:cone:angle", 180.0);
  if (outer >= 180.0) return;
  light.kind = EngineLightKind::kSpot;
  light.law = ConeLaw::kSmoothInAngle;
  light.outer_rad = outer * kRadiansPerDegree;
  light.inner_rad = light.outer_rad * (1.0 - prim.Number("inputs:shaping:cone:softness", 0.0));
}

void FromDistant(const UsdPrim& prim, const std::string& renderer, EngineLight& light) {
  light.kind = EngineLightKind::kSun;
  light.emitted = LuminanceOf(prim);
  if (renderer == "rtx_2024") {  // pi brighter than the schema's, whatever normalize says
    light.emitted *= std::numbers::pi;
    return;
  }
  if (prim.On("inputs:normalize")) return;
  const double sine = std::sin(prim.Number("inputs:angle", 0.53) * std::numbers::pi / 360.0);
  light.emitted *= std::numbers::pi * sine * sine;
}

EngineLight FromPrim(const UsdPrim& prim, const SceneFrame& frame, const std::string& renderer,
                     const FileText& beside) {
  EngineLight light;
  light.name = prim.Text("displayName").empty() ? prim.name : Unquoted(prim.Text("displayName"));
  light.offset_m = prim.Number("distance_offset_m", 0.0);
  light.rgb = ColorOf(prim);
  light.x = UnitAlong(light.name, frame.x);
  light.y = UnitAlong(light.name, frame.y);
  light.aim = UnitAlong(light.name, frame.z) * -1.0;
  light.position_m = frame.origin;
  if (prim.type == "SphereLight") {
    FromSphere(prim, beside, light);
  } else if (prim.type == "DistantLight") {
    FromDistant(prim, renderer, light);
  } else if (prim.type == "DomeLight") {
    light.kind = EngineLightKind::kDome;
    light.emitted = LuminanceOf(prim);
  } else if (prim.type == "CylinderLight") {
    light.kind = EngineLightKind::kTube;
    light.width_m = prim.Number("inputs:length", 1.0);
    light.height_m = 2.0 * prim.Number("inputs:radius", 0.5);
    light.emitted = UsdNits(prim, std::numbers::pi * light.height_m * light.width_m);
  } else {
    light.kind = EngineLightKind::kFlat;
    light.round = prim.type == "DiskLight";
    const double diameter = 2.0 * prim.Number("inputs:radius", 0.5);
    light.width_m = light.round ? diameter : prim.Number("inputs:width", 1.0);
    light.height_m = light.round ? diameter : prim.Number("inputs:height", 1.0);
    light.emitted = UsdNits(
        prim, light.width_m * light.height_m * (light.round ? std::numbers::pi / 4.0 : 1.0));
  }
  return light;
}

}  // namespace

std::vector<EngineLight> ReadUsd(const std::string& text, const FileText& beside) {
  constexpr std::string_view kTypes[] = {"SphereLight", "DistantLight",  "DomeLight",
                                         "RectLight",   "CylinderLight", "DiskLight"};
  std::vector<UsdPrim> prims = UsdPrimsOf(text);
  if (prims.size() > 1 && AreOversAlone(prims)) return {};
  const std::string space = Unquoted(prims.front().Text("colorSpace"));
  if (prims.front().Number("metersPerUnit", 0.01) != 1.0 ||
      prims.front().Text("upAxis") != "\"Z\"") {
    throw std::runtime_error("it is not in metres with Z up, as lightcal writes");
  }
  std::vector<EngineLight> lights;
  for (UsdPrim& prim : prims) {
    prim.space = space;
  }
  for (const UsdPrim& prim : prims) {
    if (std::ranges::find(kTypes, prim.type) == std::end(kTypes)) continue;
    const PlacedPrim placed = PlaceOfPrim(prims, prim);
    if (placed.hidden) continue;
    lights.push_back(FromPrim(prim, placed.frame, prims.front().Text("renderer"), beside));
  }
  return lights;
}

}  // namespace lightcal
