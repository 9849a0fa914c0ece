// SPDX-License-Identifier: Apache-2.0
// <stem>.filament.json and the same numbers as C++ in <stem>.filament.h. With I the axial
// intensity, E an illuminance, L a luminance, Y the luminance of the max-normalised colour:
//   POINT         intensityCandela I/Y;  intensity [lm] 4 pi I/Y
//   FOCUSED_SPOT  intensityCandela I/Y;  intensity [lm] 2 pi (1 - cos outer) I/Y
//                 inner_rad, outer_rad as its own cosine takes them (filament_cone.h)
//   DIRECTIONAL, SUN  intensity E/Y [lx]
//   INDIRECT      one band of irradiance, the colour; intensity L/Y. Of a picture: three bands, and
//                 <stem>-<light>.ktx with them and its cube map for mirrors (filament_ktx.h)
// setExposure(16, 307.2 k, 100) makes pixel = k L. A falloff of 1000 m is no window (one that
// was asked for is refitted in); Filament's own default in glTF files, 10 m, takes 12 % at 5 m.
// Sources: Filament 1.53.4, rendered (tests/engines/render); filament/LightManager.h.
#include <cmath>
#include <numbers>

#include "lightcal/core/file_name.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/falloff_refit.h"
#include "lightcal/presets/filament_cone.h"
#include "lightcal/presets/filament_ktx.h"
#include "lightcal/presets/gltf_light.h"
#include "lightcal/presets/preset_document.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/preset_text.h"

namespace lightcal {
namespace {

using records::Node;
constexpr EngineForms kFilament{.dome = true};
constexpr Metres kFarFalloff{1000.0};
constexpr EngineFalloff kFilamentFalloff{[](Metres d, Metres r) { return FilamentFalloff(d, r); }};
// pixel = L/(1.2 2^EV100) and 2^EV100 = N^2/t at ISO 100: N = 16 gives t = 1.2 16^2 k.
constexpr double kAperture = 16.0;
constexpr double kShutterPerScale = 1.2 * kAperture * kAperture;
constexpr double kIso = 100.0;

// Three bands, as its shader has them: E/pi is their sum over 1, y, z, x, xy, yz, 3 z^2 - 1, xz,
// x^2 - y^2, the basis' own factors and the cosine's already in them.
Node IrradianceForFilament(const EnvironmentPicture& picture) {
  constexpr double kHalfTurn = std::numbers::pi;
  const Harmonics radiance = RadianceHarmonics(picture, &GltfFromZUp);
  const double basis[] = {0.5 * std::sqrt(1.0 / kHalfTurn), std::sqrt(3.0 / (4.0 * kHalfTurn)),
                          std::sqrt(15.0 / (4.0 * kHalfTurn)), 0.25 * std::sqrt(5.0 / kHalfTurn)};
  Node list = Node::Array();
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    const double band = i == 0 ? 1.0 : i < 4 ? 2.0 / 3.0 : 0.25;  // the cosine's, over pi
    const double factor = i == 0   ? basis[0]
                          : i < 4  ? basis[1]
                          : i == 6 ? basis[3]
                          : i == 8 ? 0.5 * basis[2]
                                   : basis[2];
    list.items.push_back(NodeOf(radiance[i] * (band * factor)));
  }
  return list;
}

std::string HarmonicsText(const Node& bands) {
  std::string out;
  for (const Node& band : bands.items) {
    for (const Node& v : band.items)
      out += RoundedText(v.number, 9) + (&v == &band.items.back() ? "\n" : " ");
  }
  return out;
}

Node FilamentFigures(const PresetLight& light, const FalloffRefit& refit) {
  const PunctualLight& p = light.punctual;
  if (light.form == LightForm::kDome) {
    Node figures = {{"type", "INDIRECT"},
                    {"intensity", light.environment ? 1.0 : light.nits / p.color.luminance}};
    if (light.environment) {
      figures.Put("upward_lx", light.lux);
      figures.Put("irradiance", IrradianceForFilament(*light.environment));
    }
    return figures;
  }
  if (p.type == PunctualType::kDirectional) {
    const auto angle = light.angular_diameter_deg;
    return {{"type", angle ? "SUN" : "DIRECTIONAL"},
            {"intensity_lx", p.intensity},
            {"sun_angular_radius_deg", angle ? Node(*angle / 2.0) : Node()}};
  }
  const double intensity = p.intensity * refit.intensity_factor;
  double solid_angle_sr = 4.0 * std::numbers::pi;
  Node figures = {{"type", "POINT"}};
  if (p.type == PunctualType::kSpot) {
    figures = {{"type", "FOCUSED_SPOT"},
               {"inner_rad", AngleForFilament(p.cone.inner)},
               {"outer_rad", AngleForFilament(p.cone.outer)}};
    solid_angle_sr = 2.0 * std::numbers::pi * (1.0 - std::cos(p.cone.outer.value()));
  }
  figures.Put({{"intensity_candela", intensity},
               {"intensity_lm", intensity * solid_angle_sr},
               {"falloff_m", refit.range}});
  return figures;
}

Node FilamentNode(const FittedLight& lamp, const PresetLight& light, const FalloffRefit& refit) {
  const PunctualLight& p = light.punctual;
  Node document = {{"name", p.name}};
  document.Put(FilamentFigures(light, refit));
  document.Put({{"color", ColorNode(light)},
                {"position_m", NodeOf(GltfFromZUp(p.position_m))},
                {"direction", NodeOf(GltfFromZUp(p.aim))},
                {"measured", MeasuredNode(lamp, light)}});
  return document;
}

// ---- the snippet ----

std::string FloatsOf(const Node& list) {
  std::string out;
  for (const Node& v : list.items) out += (out.empty() ? "" : ", ") + RoundedText(v.number, 9);
  return "{" + out + "}";
}

std::string Floats(const Node& light, const char* key) { return FloatsOf(*light.Find(key)); }

std::string CommentOf(std::string name) {
  for (char& c : name) {
    if (c == '\n' || c == '\r' || c == '\\') c = ' ';
  }
  return name;
}

std::string Number(const Node& light, const char* key) {
  return "float(" + RoundedText(light.Find(key)->number, 9) + ")";
}

std::string SnippetOf(const Node& light) {
  const std::string type = light.TextAt("type");
  std::string out = "  // " + CommentOf(light.TextAt("name")) + "\n";
  if (type == "INDIRECT") {
    const Node* bands = light.Find("irradiance");
    std::string values = bands == nullptr ? Floats(light, "color") : "";
    for (std::size_t i = 0; bands != nullptr && i < bands->items.size(); ++i) {
      values += (i == 0 ? "" : ", ") + FloatsOf(bands->items[i]);
    }
    const std::string count = bands == nullptr ? "1" : "9", order = bands == nullptr ? "1" : "3";
    out += "  {\n    const filament::math::float3 irradiance[" + count + "] = {" + values +
           "};\n    filament::IndirectLight::Builder around;\n    around.irradiance(" + order +
           ", irradiance).intensity(" + Number(light, "intensity") + ");\n";
    if (bands != nullptr) {
      out += "    // The texture of " + light.TextAt("picture") +
             ", by ktxreader::Ktx1Reader::createTexture.\n"
             "    if (mirrors != nullptr) around.reflections(mirrors);\n";
    }
    return out + "    scene.setIndirectLight(around.build(engine));\n  }\n";
  }
  out +=
      "  {\n    const utils::Entity light = utils::EntityManager::get().create();\n"
      "    filament::LightManager::Builder(filament::LightManager::Type::" +
      type +
      ")\n"
      "        .color(filament::math::float3" +
      Floats(light, "color") + ")\n";
  if (light.Find("intensity_lx") != nullptr) {
    out += "        .intensity(" + Number(light, "intensity_lx") + ")\n";
  } else {
    out += "        .intensityCandela(" + Number(light, "intensity_candela") +
           ")\n"
           "        .position(" +
           Floats(light, "position_m") +
           ")\n"
           "        .falloff(" +
           Number(light, "falloff_m") + ")\n";
  }
  if (light.Find("outer_rad") != nullptr) {
    out += "        .spotLightCone(" + Number(light, "inner_rad") + ", " +
           Number(light, "outer_rad") + ")\n";
  }
  if (light.Find("sun_angular_radius_deg") != nullptr) {
    out += "        .sunAngularRadius(" + Number(light, "sun_angular_radius_deg") + ")\n";
  }
  return out + "        .direction(" + Floats(light, "direction") +
         ")\n        .build(engine, light);\n    scene.addEntity(light);\n  }\n";
}

std::string Snippet(const Node& lights, const Node& exposure) {
  std::string out =
      "// Written by lightcal: measured lights for Filament. Right-handed, Y up, metres.\n"
      "#pragma once\n#include <filament/Camera.h>\n#include <filament/Engine.h>\n"
      "#include <filament/IndirectLight.h>\n#include <filament/LightManager.h>\n"
      "#include <filament/Scene.h>\n#include <filament/Texture.h>\n#include "
      "<utils/EntityManager.h>\n\n"
      "// Set the view's ColorGrading to a linear tone mapper to compare with other engines.\n"
      "inline void AddMeasuredLights(filament::Engine& engine, filament::Scene& scene,\n"
      "                              filament::Camera& camera,\n"
      "                              const filament::Texture* mirrors = nullptr) {\n"
      "  (void)mirrors;\n"
      "  camera.setExposure(" +
      Number(exposure, "aperture") + ", " + Number(exposure, "shutter_s") + ", " +
      Number(exposure, "iso") + ");\n";
  for (const Node& light : lights.items) out += SnippetOf(light);
  return out + "}\n";
}

}  // namespace

Result<Preset> ExportFilament(const LightFile& lights, const std::string& stem,
                              const PresetOptions& asked) {
  Preset preset;
  const PresetOptions options = preset_text::InRec709(asked, "filament", preset.warnings);
  const auto forms = PresetLightsFrom(lights, kFilament, options, preset.warnings);
  if (!forms) return tl::unexpected(forms.error());
  const auto refits =
      RefitLights(lights, *forms,
                  {.falloff = kFilamentFalloff, .far_range = kFarFalloff, .fixed = options.range},
                  preset.warnings);
  const Rig rig = BuildRig(lights, *forms, options.rig_place);
  Node list = Node::Array();
  for (std::size_t i = 0; i < forms->size(); ++i) {
    list.items.push_back(FilamentNode(lights.lights[i], (*forms)[i], refits[i]));
    if ((*forms)[i].environment) {
      Node& light = list.items.back();
      const std::string ktx = stem + "-" + FileNamePart((*forms)[i].name()) + ".ktx";
      const Node& bands = *light.Find("irradiance");
      preset.files.push_back(
          {ktx, options.written != Written::kAll
                    ? std::string()
                    : FilamentKtx(*(*forms)[i].environment, HarmonicsText(bands))});
      light.Put("picture", ktx);
      preset_text::WarnOfHalfFloats((*forms)[i], "Filament", preset.warnings);
    }
    preset.derived.push_back(DerivedFrom(list.items.back()));
    NoteRefit(refits[i], preset.derived.back());
  }
  const std::string name = preset_text::SceneStem(stem, options);
  Node exposure = NodeOf(rig.exposure);
  exposure.Put({{"aperture", kAperture},
                {"shutter_s", kShutterPerScale * rig.exposure.scale},
                {"iso", kIso}});
  auto text = JsonText({{"name", name},
                        {"lights", list},
                        {"exposure", exposure},
                        {"rig", options.rig ? NodeOf(Turned(rig, GltfFromZUp)) : Node()},
                        {"provenance", NodeOf(lights.provenance)}},
                       name + ".filament.json", options.written);
  if (!text) return Propagate(std::move(text));
  preset.files.insert(preset.files.begin(), {name + ".filament.json", std::move(*text)});
  if (!options.rig) {
    const bool figures = options.written == Written::kFigures;
    preset.files.push_back(
        {stem + ".filament.h", figures ? std::string() : Snippet(list, exposure)});
  }
  return preset;
}

}  // namespace lightcal
