// SPDX-License-Identifier: Apache-2.0
// <stem>.unity.json and LightcalImporter.cs, an editor script that reads it, for Unity 2022 and 6.
// Left-handed, Y up, metres, lights along +Z; cone angles are full angles. HDRP gets physical
// units; URP, whose Lambert surfaces lack the 1/pi, gets cd and lx times
// exposure/pi. HDRP takes the inner cone in percent of the outer angle; the built-in pipeline,
// which has no inverse-square falloff, is refused by the importer. A dome's picture becomes HDRP's
// HDRI sky in lux mode; URP gets a light from above.   Sources: Unity Graphics LightUnitUtils.cs,
// HDAdditionalLightData, SkyRenderer.GetSkyIntensity, URP Lighting.hlsl; the faces of its Cubemap
// are Direct3D's.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "lightcal/presets/exporters.h"
#include "lightcal/presets/falloff_refit.h"
#include "lightcal/presets/frames.h"
#include "lightcal/presets/into_scene.h"
#include "lightcal/presets/preset_document.h"
#include "lightcal/presets/preset_text.h"
#include "lightcal/presets/scripts.h"

namespace lightcal {
namespace {

using records::Node;
constexpr EngineFalloff kUnityFalloff{[](Metres d, Metres r) { return UnityHdrpFalloff(d, r); }};
constexpr Metres kUnityFarRange{10000.0};
constexpr double kWidestSpot_deg = 179.0;  // full angle

void PutUnityCone(const PresetLight& light, DerivedLight& out, Warnings& warnings) {
  const double outer = 2.0 * DegreesFromRadians(light.cone.cone.outer);
  out.Put("spot_angle_deg", std::min(outer, kWidestSpot_deg));
  const double inner = std::min(2.0 * DegreesFromRadians(light.cone.cone.inner), kWidestSpot_deg);
  out.Put("inner_spot_angle_deg", inner);
  out.Put("inner_spot_percent", 100.0 * inner / std::min(outer, kWidestSpot_deg));
  if (outer > kWidestSpot_deg) {
    warnings.push_back({"cone_clipped", light.name(),
                        "Unity's spots end at 179 degrees full angle: exported with that"});
  }
}

// `scale` is 1 for HDRP's physical units, exposure/pi for pipelines without.
DerivedLight DeriveUnity(const PresetLight& light, const FalloffRefit& refit, double scale,
                         Warnings& warnings) {
  DerivedLight out;
  out.substitution = light.substitution;
  if (light.form == LightForm::kDome) {  // of the picture's texels, which are cd/m2
    out.type = "Sky";
    out.Put("intensity", 1.0);
    out.Put("upward_lx", light.lux);
    return out;
  }
  const double per_luminance = scale / light.color().luminance;
  if (light.form == LightForm::kDirectional) {
    out.type = "Directional";
    out.Put("intensity", light.lux * per_luminance);
    out.Put("angular_diameter_deg", light.angular_diameter_deg.value_or(0.0));
    return out;
  }
  if (light.form == LightForm::kRect) {
    out.type = "Rectangle";
    out.Put("intensity", light.nits * refit.intensity_factor * per_luminance);
    out.Put("area_width_m", light.width_m);
    out.Put("area_height_m", light.height_m);
  } else {
    out.type = light.form == LightForm::kSpot ? "Spot" : "Point";
    out.Put("intensity", light.candela * refit.intensity_factor * per_luminance);
    out.Put("radius_m", light.radius_m);
    if (light.form == LightForm::kSpot) PutUnityCone(light, out, warnings);
  }
  out.Put("range_m", refit.range.value());
  return out;
}

Node PipelineNode(const DerivedLight& derived) {
  Node document = {{"type", derived.type}};
  for (const DerivedField& field : derived.fields) document.Put(field.name, field.values[0]);
  document.Put("substituted", Node::UnlessEmpty(derived.substitution));
  return document;
}

Node PlaceNode(const std::string& name, const Vec3& at_m, const Vec3& forward, const Vec3& up) {
  return {{"name", name},
          {"position", NodeOf(PositionIn(EngineAxes::kYUpLeftHanded, at_m))},
          {"forward", NodeOf(DirectionIn(EngineAxes::kYUpLeftHanded, forward))},
          {"up", NodeOf(DirectionIn(EngineAxes::kYUpLeftHanded, up))}};
}

Node UnityNode(const PresetLight& light, const DerivedLight& hdrp, const DerivedLight& urp) {
  Node document = PlaceNode(light.name(), light.position_m(), light.aim(), light.axes.c90);
  document.Put({{"color_linear", NodeOf(light.color().max_normalised)},
                {"color_luminance", light.color().luminance},
                {"hdrp", PipelineNode(hdrp)},
                {"urp", PipelineNode(urp)}});
  return document;
}

Node RigNode(const Rig& rig) {
  const auto card_node = [&](const RigCard& card) {
    // Unity's quad is seen from its back: it faces -forward.
    Node one = PlaceNode(card.name, card.centre_m, rig.normal * -1.0, Cross(rig.normal, rig.row));
    one.Put({{"reflectance", card.reflectance}, {"illuminance_lx", card.illuminance}});
    return one;
  };
  const Vec3 view = rig.camera.target_m - rig.camera.position_m;
  Node camera =
      PlaceNode("rig camera", rig.camera.position_m, view * (1.0 / Length(view)), rig.camera.up);
  camera.Put("vertical_fov_deg", DegreesFromRadians(rig.camera.vertical_fov));
  return {{"side_m", rig.side},
          {"cards", Node::List(rig.cards, card_node)},
          {"camera", std::move(camera)}};
}

}  // namespace

Result<Preset> ExportUnity(const LightFile& lights, const std::string& stem,
                           const PresetOptions& asked) {
  Preset preset;
  const PresetOptions options = preset_text::InRec709(asked, "unity", preset.warnings);
  const auto forms = PresetLightsFrom(lights, {.sphere = true, .rect = true, .pictured_dome = true},
                                      options, preset.warnings);
  if (!forms) return tl::unexpected(forms.error());
  Warnings of_urp;  // what HDRP's do not say is said by each light's "substituted"
  const auto plain = PresetLightsFrom(lights, {.sphere = true}, options, of_urp);
  if (!plain) return tl::unexpected(plain.error());
  const RefitRequest request = {
      .falloff = kUnityFalloff, .far_range = kUnityFarRange, .fixed = options.range};
  const auto refits = RefitLights(lights, *forms, request, preset.warnings);
  const Rig rig = BuildRig(lights, *forms, options.rig_place);
  const double unitless = rig.exposure.scale / std::numbers::pi;
  Node list = Node::Array();
  std::vector<PresetFile> pictures;
  for (std::size_t i = 0; i < forms->size(); ++i) {
    preset.derived.push_back(DeriveUnity((*forms)[i], refits[i], 1.0, preset.warnings));
    NoteRefit(refits[i], preset.derived.back());
    const DerivedLight urp = DeriveUnity((*plain)[i], refits[i], unitless, of_urp);
    list.items.push_back(UnityNode((*forms)[i], preset.derived.back(), urp));
    if ((*forms)[i].form == LightForm::kDome) {
      pictures.push_back(preset_text::PictureFileOf(
          (*forms)[i], stem, options, preset_text::PictureEncoding::kRadiance, preset.warnings));
      list.items.back().Put({{"picture", pictures.back().name}, {"upward_lx", (*forms)[i].lux}});
      preset_text::WarnOfHalfFloats((*forms)[i], "Unity", preset.warnings);
    }
    preset.derived.back().Put("urp_intensity", urp.Find("intensity")->values[0]);
    const Rgb& c = (*forms)[i].color().max_normalised;
    preset.derived.back().elsewhere.push_back({"color", {c.r, c.g, c.b}});
    preset.derived.back().elsewhere.push_back(
        {"light_color", {SrgbEncoded(c.r), SrgbEncoded(c.g), SrgbEncoded(c.b)}});
  }
  const std::string name = preset_text::SceneStem(stem, options);
  Node root = {{"schema", "lightcal.unity/1"},
               {"generator", preset_text::GeneratorOf(lights)},
               {"name", name},
               {"note", "not executed in Unity: schema-checked"},
               {"exposure", Node{{"ev100", rig.exposure.ev100}, {"scale", rig.exposure.scale}}},
               {"lights", std::move(list)}};
  root.Put("into", IntoNode(options.into));
  if (options.rig) root.Put(RigNode(rig));
  auto text = JsonText(root, name + ".unity.json", options.written);
  if (!text) return Propagate(std::move(text));
  preset.files = {{name + ".unity.json", *std::move(text)},
                  {"LightcalImporter.cs", std::string(Script("LightcalImporter.cs"))}};
  const std::string with = pictures.empty()
                               ? " and LightcalImporter.cs from "
                               : ", " + pictures.front().name + " and LightcalImporter.cs from ";
  std::ranges::move(pictures, std::back_inserter(preset.files));
  preset.paste = "copy " + name + ".unity.json" + with + std::string(kPasteDirectory) +
                 " into Assets/Editor, then Tools > lightcal > Import preset" +
                 (options.rig ? ": opens a scene of its own" : "");
  return preset;
}

Emission EmittedInUnity(const DerivedLight& light, LightKind /*kind*/, double /*axial_part*/) {
  if (light.type == "Sky") return {.lux = NumberIn(light, "upward_lx")};
  const double emitted = NumberIn(light, "intensity") * LuminanceIn(light, "color");
  if (light.type == "Directional") return {.lux = emitted};
  Emission out{.candela = emitted, .falloff = kUnityFalloff, .range_m = NumberIn(light, "range_m")};
  if (light.type == "Spot") {
    const double outer = RadiansFromDegrees(NumberIn(light, "spot_angle_deg")).value() / 2.0;
    out.cone = ConeOfLaw{.inner_rad = outer * NumberIn(light, "inner_spot_percent") / 100.0,
                         .outer_rad = outer};
  }
  if (light.type == "Rectangle") {
    const double width = NumberIn(light, "area_width_m");
    const double height = NumberIn(light, "area_height_m");
    out.candela = emitted * width * height;
    out.shape = {AxialShape::Outline::kRect, 0.5 * width, 0.5 * height};
  }
  return out;
}

}  // namespace lightcal
