// SPDX-License-Identifier: Apache-2.0
// <stem>.preset.json, schema lightcal.preset/1: the canonical record of the lights with every
// number other targets are given, so that a reader can audit them. schemas/preset.schema.json
// describes it.
#include <nlohmann/json.hpp>

#include "lightcal/presets/exporters.h"
#include "lightcal/presets/json_pieces.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/presets/rig_pieces.h"

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

Json RgbOf(const EmittedColor& color) {
  return {{"unit_luminance", RgbJson(color.unit_luminance)},
          {"max_normalised", RgbJson(color.max_normalised)},
          {"luminance_of_max_normalised", color.luminance}};
}

// What the engines of this export get, where that is not plain Rec. 709.
Json PipelineColor(const EmittedColor& color) {
  Json json = {{"space", RgbSpaceWord(color.target.space)}};
  if (color.target.white) json["white_xy"] = {color.target.white->x, color.target.white->y};
  json.update(RgbOf(color));
  return json;
}

Json Color(const FittedLight& lamp, const EmittedColor& color) {
  const FittedColor& measured = lamp.color;
  Json json = {{"known", color.xy.has_value()}};
  if (color.xy) json["xy"] = {color.xy->x, color.xy->y};
  Put<Json>(json, "cct_K", measured.cct_K);
  Put<Json>(json, "duv", measured.duv);
  Warnings said_already;
  json["rec709_linear"] = RgbOf(ColorOfLight(lamp, {}, said_already));
  if (color.target.white || color.target.space != RgbSpace::kSrgb) {
    json["pipeline_linear"] = PipelineColor(color);
  }
  return json;
}

Json Geometry(const FittedLight& lamp) {
  Json json = Json::object();
  if (lamp.position_m) json["position_m"] = Array<Json>(*lamp.position_m);
  if (lamp.aim) json["aim"] = Array<Json>(*lamp.aim);
  if (lamp.axis) json["axis"] = Array<Json>(*lamp.axis);
  Put<Json>(json, "inner_deg", lamp.inner_deg);
  Put<Json>(json, "outer_deg", lamp.outer_deg);
  Put<Json>(json, "diameter_m", lamp.diameter_m);
  Put<Json>(json, "width_m", lamp.width_m);
  Put<Json>(json, "height_m", lamp.height_m);
  Put<Json>(json, "length_m", lamp.length_m);
  Put<Json>(json, "radius_m", lamp.radius_m);
  Put<Json>(json, "angular_diameter_deg", lamp.angular_diameter_deg);
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

// ---- what other targets are given ----

struct Derivation {
  std::string_view target;
  std::vector<DerivedLight> lights;
};

// A target that refuses these lights derives nothing; whoever exports to it is told why.
std::vector<Derivation> Derivations(const LightFile& file, const std::string& stem,
                                    const PresetOptions& options) {
  std::vector<Derivation> all;
  for (const PresetTarget& target : PresetTargets()) {
    if (target.exporter == &ExportJson) continue;
    auto preset = target.exporter(file, stem, options);
    if (!preset || preset->derived.size() != file.lights.size()) continue;
    all.push_back({target.name, std::move(preset->derived)});
  }
  return all;
}

Json DerivedJson(const DerivedLight& light) {
  Json json = {{"type", light.type}};
  for (const DerivedField& field : light.fields) {
    if (field.values.size() == 1) {
      json[field.name] = field.values.front();
    } else {
      json[field.name] = field.values;
    }
  }
  for (const DerivedField& note : light.notes) json[note.name] = note.values.front();
  if (!light.substitution.empty()) json["substituted"] = light.substitution;
  return json;
}

// Values times the exposure, for pipelines that hold light in half floats.
Json PreExposed(const PresetLight& light, double exposure) {
  constexpr double kLargestHalf = 65504.0;
  Json json = Json::object();
  bool safe = true;
  const std::pair<const char*, double> values[] = {{"intensity_cd", light.candela},
                                                   {"illuminance_lx", light.lux},
                                                   {"luminance_nits", light.nits}};
  for (const auto& [name, value] : values) {
    if (!(value > 0.0)) continue;
    json[name] = value * exposure;
    safe = safe && value * exposure <= kLargestHalf;
  }
  json["fits_fp16"] = safe;
  return json;
}

void WarnOfHalfFloats(const PresetLight& light, double exposure, Warnings& warnings) {
  constexpr double kLargestHalf = 65504.0;
  if (light.nits * exposure <= kLargestHalf) return;
  warnings.push_back({"exceeds_fp16", light.name(),
                      "its surface is brighter than half floats hold even at this exposure; hide "
                      "the disc, or let it clip at 65504"});
}

Json LightJson(const FittedLight& lamp, const PresetLight& form, std::size_t index,
               const std::vector<Derivation>& derivations, double exposure) {
  Json json = {{"name", lamp.name},
               {"kind", LightKindName(lamp.kind)},
               {"photometry", Photometry(lamp)},
               {"color", Color(lamp, form.color())},
               {"geometry", Geometry(lamp)},
               {"fit", Fit(lamp.fit)},
               {"pre_exposed", PreExposed(form, exposure)}};
  if (form.table) {
    json["distribution"] = {{"peak_cd", form.candela}, {"flux_lm", form.lumens}};
    const auto& grid = form.table->grid();
    json["distribution"]["planes"] = grid.horizontal_deg.size();
    json["distribution"]["angles"] = grid.vertical_deg.size();
  }
  for (const Derivation& derivation : derivations) {
    json["derived"][std::string(derivation.target)] = DerivedJson(derivation.lights[index]);
  }
  return json;
}

// The rig's illuminances are those of the lamps themselves, whatever an engine makes of them.
constexpr EngineForms kEveryForm{
    .sphere = true, .disk = true, .rect = true, .tube = true, .table = true, .dome = true};

}  // namespace

Result<Preset> ExportJson(const LightFile& lights, const std::string& stem,
                          const PresetOptions& options) {
  Preset preset;
  const auto punctual = PunctualLightsFrom(lights, preset.warnings, options.color);
  if (!punctual) return tl::unexpected(punctual.error());
  Warnings said_already;
  const auto forms = PresetLightsFrom(lights, kEveryForm, options, said_already);
  if (!forms) return tl::unexpected(forms.error());
  const Rig rig = BuildRig(lights, *forms);
  const auto derivations = Derivations(lights, stem, options);
  Json root = {{"schema", "lightcal.preset/1"}, {"name", stem}};
  root["lights"] = Json::array();
  for (std::size_t i = 0; i < punctual->size(); ++i) {
    root["lights"].push_back(
        LightJson(lights.lights[i], (*forms)[i], i, derivations, rig.exposure.scale));
    WarnOfHalfFloats((*forms)[i], rig.exposure.scale, preset.warnings);
  }
  root["exposure"] = json_pieces::ExposureJson<Json>(rig.exposure);
  if (!options.bare) root["rig"] = json_pieces::RigJson<Json>(rig);
  root["provenance"] = json_pieces::ProvenanceJson<Json>(lights.provenance);
  auto text = json_pieces::TextOf(root, stem + ".preset.json");
  if (!text) return Propagate(std::move(text));
  preset.files.push_back({stem + ".preset.json", std::move(*text)});
  return preset;
}

}  // namespace lightcal
