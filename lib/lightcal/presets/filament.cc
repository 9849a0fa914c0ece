// SPDX-License-Identifier: Apache-2.0
// <stem>.filament.json and the same numbers as C++ in <stem>.filament.h. With I the axial
// intensity, E an illuminance, L a luminance, Y the luminance of the max-normalised colour:
//   POINT         intensityCandela I/Y;  intensity [lm] 4 pi I/Y
//   FOCUSED_SPOT  intensityCandela I/Y;  intensity [lm] 2 pi (1 - cos outer) I/Y
//   DIRECTIONAL, SUN  intensity E/Y [lx]
//   INDIRECT      one band of irradiance, the colour; intensity L/Y
// setExposure(16, 307.2 k, 100) makes pixel = k L. A falloff of 1000 m is no window: Filament's
// own default in glTF files, 10 m, takes 12 % at 5 m.
// Sources: Filament 1.53.4, rendered (tests/engines/render); filament/LightManager.h.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/gltf_light.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/rig_pieces.h"

namespace lightcal {
namespace {

using Json = nlohmann::ordered_json;
using json_pieces::Array;

constexpr EngineForms kFilament{.dome = true};
constexpr double kFalloff_m = 1000.0;
// pixel = L/(1.2 2^EV100) and 2^EV100 = N^2/t at ISO 100: N = 16 gives t = 1.2 16^2 k.
constexpr double kAperture = 16.0;
constexpr double kShutterPerScale = 1.2 * kAperture * kAperture;
constexpr double kIso = 100.0;

void AddFigures(const PresetLight& light, Json& json) {
  const PunctualLight& p = light.punctual;
  if (light.form == LightForm::kDome) {
    json["type"] = "INDIRECT";
    json["intensity"] = light.nits / p.color.luminance;
    return;
  }
  if (p.type == PunctualType::kDirectional) {
    json["type"] = light.angular_diameter_deg ? "SUN" : "DIRECTIONAL";
    json["intensity_lx"] = p.intensity;
    if (light.angular_diameter_deg) {
      json["sun_angular_radius_deg"] = *light.angular_diameter_deg / 2.0;
    }
    return;
  }
  double solid_angle_sr = 4.0 * std::numbers::pi;
  if (p.type == PunctualType::kSpot) {
    json["type"] = "FOCUSED_SPOT";
    json["inner_rad"] = p.cone.inner.value();
    json["outer_rad"] = p.cone.outer.value();
    solid_angle_sr = 2.0 * std::numbers::pi * (1.0 - std::cos(p.cone.outer.value()));
  } else {
    json["type"] = "POINT";
  }
  json["intensity_candela"] = p.intensity;
  json["intensity_lm"] = p.intensity * solid_angle_sr;
  json["falloff_m"] = kFalloff_m;
}

Json LightJson(const FittedLight& lamp, const PresetLight& light) {
  const PunctualLight& p = light.punctual;
  Json json = {{"name", p.name}};
  AddFigures(light, json);
  const Rgb& c = p.color.max_normalised;
  json["color"] = {c.r, c.g, c.b};
  json["position_m"] = Array<Json>(GltfFromZUp(p.position_m));
  json["direction"] = Array<Json>(GltfFromZUp(p.aim));
  json["measured"] = json_pieces::MeasuredJson<Json>(lamp, light);
  return json;
}

// ---- the snippet ----

std::string Floats(const Json& list) {
  std::string out;
  for (const auto& v : list) {
    out += (out.empty() ? "" : ", ") + RoundedText(v.get<double>(), 9);
  }
  return "{" + out + "}";
}

std::string CommentOf(std::string name) {
  for (char& c : name) {
    if (c == '\n' || c == '\r' || c == '\\') c = ' ';
  }
  return name;
}

std::string Number(const Json& light, const char* key) {
  return "float(" + RoundedText(light.at(key).get<double>(), 9) + ")";
}

std::string SnippetOf(const Json& light) {
  const std::string type = light.at("type").get<std::string>();
  std::string out = "  // " + CommentOf(light.at("name").get<std::string>()) + "\n";
  if (type == "INDIRECT") {
    return out + "  {\n    const filament::math::float3 irradiance[1] = {" +
           Floats(light.at("color")) +
           "};\n    scene.setIndirectLight(filament::IndirectLight::Builder()\n"
           "        .irradiance(1, irradiance)\n        .intensity(" +
           Number(light, "intensity") + ")\n        .build(engine));\n  }\n";
  }
  out +=
      "  {\n    const utils::Entity light = utils::EntityManager::get().create();\n"
      "    filament::LightManager::Builder(filament::LightManager::Type::" +
      type +
      ")\n"
      "        .color(filament::math::float3" +
      Floats(light.at("color")) + ")\n";
  if (light.contains("intensity_lx")) {
    out += "        .intensity(" + Number(light, "intensity_lx") + ")\n";
  } else {
    out += "        .intensityCandela(" + Number(light, "intensity_candela") +
           ")\n"
           "        .position(" +
           Floats(light.at("position_m")) +
           ")\n"
           "        .falloff(" +
           Number(light, "falloff_m") + ")\n";
  }
  if (light.contains("outer_rad")) {
    out += "        .spotLightCone(" + Number(light, "inner_rad") + ", " +
           Number(light, "outer_rad") + ")\n";
  }
  if (light.contains("sun_angular_radius_deg")) {
    out += "        .sunAngularRadius(" + Number(light, "sun_angular_radius_deg") + ")\n";
  }
  return out + "        .direction(" + Floats(light.at("direction")) +
         ")\n        .build(engine, light);\n    scene.addEntity(light);\n  }\n";
}

std::string Snippet(const Json& root) {
  const Json& exposure = root.at("exposure");
  std::string out =
      "// Written by lightcal: measured lights for Filament. Right-handed, Y up, metres.\n"
      "#pragma once\n#include <filament/Camera.h>\n#include <filament/Engine.h>\n"
      "#include <filament/IndirectLight.h>\n#include <filament/LightManager.h>\n"
      "#include <filament/Scene.h>\n#include <utils/EntityManager.h>\n\n"
      "// Set the view's ColorGrading to a linear tone mapper to compare with other engines.\n"
      "inline void AddMeasuredLights(filament::Engine& engine, filament::Scene& scene,\n"
      "                              filament::Camera& camera) {\n"
      "  camera.setExposure(" +
      Number(exposure, "aperture") + ", " + Number(exposure, "shutter_s") + ", " +
      Number(exposure, "iso") + ");\n";
  for (const Json& light : root.at("lights")) out += SnippetOf(light);
  return out + "}\n";
}

}  // namespace

Result<Preset> ExportFilament(const LightFile& lights, const std::string& stem,
                              const PresetOptions& options) {
  Preset preset;
  const auto forms = PresetLightsFrom(lights, kFilament, options, preset.warnings);
  if (!forms) return tl::unexpected(forms.error());
  const Rig rig = BuildRig(lights, *forms);
  Json root = {{"name", stem}};
  root["lights"] = Json::array();
  for (std::size_t i = 0; i < forms->size(); ++i) {
    root["lights"].push_back(LightJson(lights.lights[i], (*forms)[i]));
  }
  for (const Json& light : root["lights"]) {
    preset.derived.push_back(json_pieces::DerivedFrom(light));
  }
  root["exposure"] = json_pieces::ExposureJson<Json>(rig.exposure);
  root["exposure"]["aperture"] = kAperture;
  root["exposure"]["shutter_s"] = kShutterPerScale * rig.exposure.scale;
  root["exposure"]["iso"] = kIso;
  if (!options.bare) {
    root["rig"] = json_pieces::RigJson<Json>(json_pieces::Turned(rig, GltfFromZUp));
  }
  root["provenance"] = json_pieces::ProvenanceJson<Json>(lights.provenance);
  auto text = json_pieces::TextOf(root, stem + ".filament.json");
  if (!text) return Propagate(std::move(text));
  preset.files.push_back({stem + ".filament.json", std::move(*text)});
  preset.files.push_back({stem + ".filament.h", Snippet(root)});
  return preset;
}

}  // namespace lightcal
