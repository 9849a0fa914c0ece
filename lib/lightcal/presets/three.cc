// SPDX-License-Identifier: Apache-2.0
// <stem>.three.js: one ES module for three.js and Babylon.js. With I the axial intensity, E an
// illuminance, L a luminance, Y the luminance of the max-normalised colour:
//   point, spot, measured  I/Y [cd]   directional  E/Y [lx]   rect, disk, dome  L/Y [cd/m2]
// three's spot falls smoothly (smoothstep in the cosine) from angle (1 - penumbra) to angle, so
// penumbra = 1 - inner/outer; Babylon's as glTF. A disk becomes the square of its area.
// Sources: three.js 0.187, Babylon.js 9.34, rendered (tests/engines/render).
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "lightcal/presets/exporters.h"
#include "lightcal/presets/gltf_light.h"
#include "lightcal/presets/photometric_files.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/rig_pieces.h"
#include "lightcal/presets/scripts.h"

namespace lightcal {
namespace {

using Json = nlohmann::ordered_json;
using json_pieces::Array;

constexpr EngineForms kThree{.rect = true, .table = true, .dome = true};

void AddPunctual(const PunctualLight& light, Json& json) {
  json["intensity"] = light.intensity;
  switch (light.type) {
    case PunctualType::kPoint:
      json["type"] = "point";
      json["unit"] = "cd";
      return;
    case PunctualType::kDirectional:
      json["type"] = "directional";
      json["unit"] = "lx";
      return;
    case PunctualType::kSpot:
      json["type"] = "spot";
      json["unit"] = "cd";
      json["inner_rad"] = light.cone.inner.value();
      json["outer_rad"] = light.cone.outer.value();
      return;
  }
}

// What the light is where the engine has no such kind.
Json Fallback(const PunctualLight& light) {
  Json json = Json::object();
  AddPunctual(light, json);
  return json;
}

void AddRect(const PresetLight& light, Json& json) {
  json["type"] = "rect";
  json["intensity"] = light.nits / light.color().luminance;
  json["unit"] = "cd/m2";
  json["width_m"] = light.width_m;
  json["height_m"] = light.height_m;
  json["axes"] = {Array<Json>(GltfFromZUp(light.axes.c0)), Array<Json>(GltfFromZUp(light.axes.c90)),
                  Array<Json>(GltfFromZUp(light.axes.aim * -1.0))};
  json["fallback"] = Fallback(light.punctual);
}

// The mean of all C planes over the peak, at the middle of each of 720 steps of gamma.
Json RoundProfile(const IntensityTable& table) {
  constexpr int kSteps = 720;
  constexpr int kTurn = 72;
  Json profile = Json::array();
  for (int i = 0; i < kSteps; ++i) {
    const Radians gamma((i + 0.5) * std::numbers::pi / kSteps);
    double sum = 0.0;
    for (int c = 0; c < kTurn; ++c) {
      sum += table.At(Radians(2.0 * std::numbers::pi * c / kTurn), gamma).value();
    }
    profile.push_back(std::round(1e6 * sum / kTurn / table.peak().intensity.value()) / 1e6);
  }
  return profile;
}

void AddTable(const PresetLight& light, const std::string& ies, Json& json) {
  json["type"] = "ies";
  json["intensity"] = light.candela / light.color().luminance;
  json["unit"] = "cd";
  json["ies"] = ies;
  json["profile"] = RoundProfile(*light.table);
  json["fallback"] = Fallback(light.punctual);
}

Json LightJson(const FittedLight& lamp, const PresetLight& light, const std::string& ies) {
  const PunctualLight& p = light.punctual;
  Json json = {{"name", p.name}};
  const Rgb& c = p.color.max_normalised;
  json["color"] = {c.r, c.g, c.b};
  json["position_m"] = Array<Json>(GltfFromZUp(p.position_m));
  json["direction"] = Array<Json>(GltfFromZUp(p.aim));
  switch (light.form) {
    case LightForm::kRect:
      AddRect(light, json);
      break;
    case LightForm::kDome:
      json["type"] = "dome";
      json["intensity"] = light.nits / p.color.luminance;
      json["unit"] = "cd/m2";
      break;
    case LightForm::kTable:
      AddTable(light, ies, json);
      break;
    default:
      AddPunctual(p, json);
      break;
  }
  json["measured"] = json_pieces::MeasuredJson<Json>(lamp, light);
  return json;
}

}  // namespace

Result<Preset> ExportThree(const LightFile& lights, const std::string& stem,
                           const PresetOptions& options) {
  Preset preset;
  const auto forms = PresetLightsFrom(lights, kThree, options, preset.warnings);
  if (!forms) return tl::unexpected(forms.error());
  const auto ies = IesFiles(lights, stem);
  if (!ies) return tl::unexpected(ies.error());
  const Rig rig = BuildRig(lights, *forms);
  Json root = {{"name", stem}};
  root["lights"] = Json::array();
  for (std::size_t i = 0; i < forms->size(); ++i) {
    const std::string table = (*ies)[i] ? (*ies)[i]->contents : std::string();
    root["lights"].push_back(LightJson(lights.lights[i], (*forms)[i], table));
  }
  for (const Json& light : root["lights"]) {
    preset.derived.push_back(json_pieces::DerivedFrom(light));
  }
  root["exposure"] = json_pieces::ExposureJson<Json>(rig.exposure);
  if (!options.bare) {
    root["rig"] = json_pieces::RigJson<Json>(json_pieces::Turned(rig, GltfFromZUp));
  }
  root["provenance"] = json_pieces::ProvenanceJson<Json>(lights.provenance);
  auto text = json_pieces::TextOf(root, stem + ".three.js");
  if (!text) return Propagate(std::move(text));
  text->pop_back();
  preset.files.push_back({stem + ".three.js", ScriptWith("three.js", *text)});
  return preset;
}

}  // namespace lightcal
