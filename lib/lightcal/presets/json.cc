// SPDX-License-Identifier: Apache-2.0
// <stem>.preset.json, schema lightcal.preset/1: the canonical record of the lights with every
// number other targets are given, so that a reader can audit them. schemas/preset.schema.json
// describes it.
#include <nlohmann/json.hpp>

#include "lightcal/presets/exporters.h"
#include "lightcal/presets/gltf_light.h"
#include "lightcal/presets/json_pieces.h"
#include "lightcal/presets/rig.h"

namespace lightcal {
namespace {

using Json = nlohmann::ordered_json;
using json_pieces::Array;
using json_pieces::Put;

Json RgbJson(const Rgb& c) { return Array<Json>(std::array<double, 3>{c.r, c.g, c.b}); }

Json Photometry(const FittedLight& lamp) {
  Json json = Json::object();
  Put<Json>(json, "intensity_cd", lamp.intensity_cd);
  Put<Json>(json, "flux_lm", lamp.flux_lm);
  Put<Json>(json, "illuminance_lx", lamp.illuminance_lx);
  Put<Json>(json, "luminance_nits", lamp.luminance_nits);
  Put<Json>(json, "distance_offset_m", lamp.distance_offset_m);
  return json;
}

Json Color(const FittedColor& measured, const EmittedColor& color) {
  Json json = {{"known", color.xy.has_value()}};
  if (color.xy) json["xy"] = {color.xy->x, color.xy->y};
  Put<Json>(json, "cct_K", measured.cct_K);
  Put<Json>(json, "duv", measured.duv);
  json["rec709_linear"] = {{"unit_luminance", RgbJson(color.unit_luminance)},
                           {"max_normalised", RgbJson(color.max_normalised)},
                           {"luminance_of_max_normalised", color.luminance}};
  return json;
}

Json Geometry(const FittedLight& lamp) {
  Json json = Json::object();
  if (lamp.position_m) json["position_m"] = Array<Json>(*lamp.position_m);
  if (lamp.aim) json["aim"] = Array<Json>(*lamp.aim);
  Put<Json>(json, "inner_deg", lamp.inner_deg);
  Put<Json>(json, "outer_deg", lamp.outer_deg);
  Put<Json>(json, "diameter_m", lamp.diameter_m);
  Put<Json>(json, "width_m", lamp.width_m);
  Put<Json>(json, "height_m", lamp.height_m);
  Put<Json>(json, "length_m", lamp.length_m);
  Put<Json>(json, "radius_m", lamp.radius_m);
  return json;
}

Json Fit(const FitDiagnostics& fit) {
  Json json = {{"readings", fit.readings},
               {"used", fit.used},
               {"rejected", fit.rejected},
               {"degrees_of_freedom", fit.degrees_of_freedom}};
  Put<Json>(json, "rms_relative", fit.rms_relative);
  Put<Json>(json, "chi2_dof", fit.chi2_dof);
  Put<Json>(json, "leave_one_out", fit.leave_one_out);
  json["learned"] = fit.learned;
  json["prior"] = fit.prior;
  return json;
}

Json DerivedGltf(const GltfLight& light) {
  Json json = {{"type", light.type}, {"intensity", light.intensity}};
  Put<Json>(json, "intensity_u95", light.intensity_u95);
  json["color"] = Array<Json>(light.color);
  Put<Json>(json, "range", light.range_m);
  Put<Json>(json, "innerConeAngle", light.inner_cone_rad);
  Put<Json>(json, "outerConeAngle", light.outer_cone_rad);
  json["translation"] = Array<Json>(light.translation);
  json["rotation"] = Array<Json>(light.rotation);
  return json;
}

Json LightJson(const FittedLight& lamp, const PunctualLight& light) {
  Json json = {{"name", lamp.name},
               {"kind", LightKindName(lamp.kind)},
               {"photometry", Photometry(lamp)},
               {"color", Color(lamp.color, light.color)},
               {"geometry", Geometry(lamp)},
               {"fit", Fit(lamp.fit)},
               {"derived", {{"gltf", DerivedGltf(GltfLightFrom(light))}}}};
  if (!light.substitution.empty()) json["derived"]["gltf"]["substituted"] = light.substitution;
  return json;
}

Json CardJson(const RigCard& card) {
  return {{"name", card.name},
          {"reflectance", card.reflectance},
          {"centre_m", Array<Json>(card.centre_m)},
          {"illuminance_lx", card.illuminance.value()},
          {"luminance_nits", card.luminance.value()}};
}

Json RigJson(const Rig& rig) {
  Json json = {{"light", rig.light},
               {"distance_m", rig.distance.value()},
               {"from_reading", rig.from_reading},
               {"normal", Array<Json>(rig.normal)},
               {"side_m", rig.side.value()}};
  json["cards"] = {CardJson(rig.cards[0]), CardJson(rig.cards[1])};
  json["camera"] = {{"position_m", Array<Json>(rig.camera.position_m)},
                    {"target_m", Array<Json>(rig.camera.target_m)},
                    {"up", Array<Json>(rig.camera.up)},
                    {"vertical_fov_deg", DegreesFromRadians(rig.camera.vertical_fov)},
                    {"aspect_ratio", rig.camera.aspect_ratio}};
  return json;
}

}  // namespace

Result<Preset> ExportJson(const LightFile& lights, const std::string& stem,
                          const PresetOptions& options) {
  Preset preset;
  const auto punctual = PunctualLightsFrom(lights, preset.warnings, options.color);
  if (!punctual) return tl::unexpected(punctual.error());
  const Rig rig = BuildRig(lights, *punctual);
  Json root = {{"schema", "lightcal.preset/1"}, {"name", stem}};
  root["lights"] = Json::array();
  for (std::size_t i = 0; i < punctual->size(); ++i) {
    root["lights"].push_back(LightJson(lights.lights[i], (*punctual)[i]));
  }
  root["exposure"] = {{"ev100", rig.exposure.ev100}, {"exposure", rig.exposure.scale}};
  if (!options.bare) root["rig"] = RigJson(rig);
  root["provenance"] = json_pieces::ProvenanceJson<Json>(lights.provenance);
  auto text = json_pieces::TextOf(root, stem + ".preset.json");
  if (!text) return Propagate(std::move(text));
  preset.files.push_back({stem + ".preset.json", std::move(*text)});
  return preset;
}

}  // namespace lightcal
