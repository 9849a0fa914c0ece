// SPDX-License-Identifier: Apache-2.0
// <stem>.preset.json, schema lightcal.preset/1: the canonical record of the lights with every
// number other targets are given, so that a reader can audit them. schemas/preset.schema.json
// describes it.
#include <algorithm>
#include <utility>

#include "lightcal/photometry/half_range.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/photometric_files.h"
#include "lightcal/presets/preset_document.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/presets/preset_text.h"
#include "lightcal/presets/turned_panorama.h"

namespace lightcal {
namespace {

using records::Node;
Node Photometry(const FittedLight& lamp) {
  return {{"intensity_cd", NodeOf(lamp.intensity_cd)},
          {"flux_lm", NodeOf(lamp.flux_lm)},
          {"illuminance_lx", NodeOf(lamp.illuminance_lx)},
          {"luminance_nits", NodeOf(lamp.luminance_nits)},
          {"distance_offset_m", NodeOf(lamp.distance_offset_m)}};
}

Node RgbOf(const EmittedColor& color) {
  return {{"unit_luminance", NodeOf(color.unit_luminance)},
          {"max_normalised", NodeOf(color.max_normalised)},
          {"luminance_of_max_normalised", color.luminance}};
}

Node Pair(const std::optional<Xy>& xy) { return xy ? Node{xy->x, xy->y} : Node(); }

// What the engines of this export get, where that is not plain Rec. 709.
Node PipelineColor(const EmittedColor& color) {
  if (!color.target.white && color.target.space == RgbSpace::kSrgb) return {};
  Node document = {{"space", RgbSpaceWord(color.target.space)},
                   {"white_xy", Pair(color.target.SceneWhite())}};
  document.Put(RgbOf(color));
  return document;
}

Node Color(const FittedLight& lamp, const EmittedColor& color) {
  Warnings said_already;
  return {{"known", color.xy.has_value()},
          {"xy", Pair(color.xy)},
          {"cct_K", NodeOf(lamp.color.cct_K)},
          {"duv", NodeOf(lamp.color.duv)},
          {"rec709_linear", RgbOf(ColorOfLight(lamp, {}, said_already))},
          {"pipeline_linear", PipelineColor(color)}};
}

Node Triple(const std::optional<Vec3>& v) { return v ? NodeOf(*v) : Node(); }

Node Geometry(const FittedLight& lamp) {
  return {{"position_m", Triple(lamp.position_m)},
          {"aim", Triple(lamp.aim)},
          {"axis", Triple(lamp.axis)},
          {"inner_deg", lamp.inner_deg},
          {"outer_deg", lamp.outer_deg},
          {"diameter_m", lamp.diameter_m},
          {"width_m", lamp.width_m},
          {"height_m", lamp.height_m},
          {"length_m", lamp.length_m},
          {"radius_m", lamp.radius_m},
          {"angular_diameter_deg", lamp.angular_diameter_deg}};
}

Node Fit(const FitDiagnostics& fit) {
  return {{"readings", fit.readings},
          {"used", fit.used},
          {"rejected", fit.rejected},
          {"degrees_of_freedom", fit.degrees_of_freedom},
          {"rms_relative", fit.rms_relative},
          {"chi2_dof", fit.chi2_dof},
          {"leave_one_out", fit.leave_one_out},
          {"learned", fit.learned},
          {"prior", fit.prior}};
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
  PresetOptions figures = options;
  figures.written = Written::kFigures;
  for (const PresetTarget& target : PresetTargets()) {
    if (target.exporter == &ExportJson || target.only_if_named) continue;
    auto preset = target.exporter(file, stem, figures);
    if (!preset || preset->derived.size() != file.lights.size()) continue;
    all.push_back({target.name, std::move(preset->derived)});
  }
  return all;
}

Node DerivedNode(const DerivedLight& light) {
  Node document = {{"type", light.type}};
  for (const DerivedField& field : light.fields) {
    const bool one = field.values.size() == 1;
    document.Put(field.name, one ? Node(field.values.front()) : Node(field.values));
  }
  for (const DerivedField& note : light.notes) document.Put(note.name, note.values.front());
  document.Put("substituted", Node::UnlessEmpty(light.substitution));
  return document;
}

// Values times the exposure, for pipelines that hold light in half floats.
Node PreExposedNode(const PresetLight& light, double exposure) {
  Node document = Node::Table();
  bool safe = true;
  const std::pair<const char*, double> values[] = {{"intensity_cd", light.candela},
                                                   {"illuminance_lx", light.lux},
                                                   {"luminance_nits", light.nits}};
  for (const auto& [name, value] : values) {
    if (!(value > 0.0)) continue;
    document.Put(name, value * exposure);
    safe = safe && value * exposure <= kLargestHalf;
  }
  document.Put("fits_fp16", safe);
  return document;
}

void WarnOfHalfFloats(const PresetLight& light, double exposure, Warnings& warnings) {
  if (light.nits * exposure <= kLargestHalf) return;
  warnings.push_back({"exceeds_fp16", light.name(),
                      "its surface is brighter than half floats hold even at this exposure; hide "
                      "the disc, or let it clip at 65504"});
}

// ies: what the target of that name calls this light's file.
Node Distribution(const PresetLight& form, const std::optional<PresetFile>& ies) {
  if (!form.table) return {};
  const auto& grid = form.table->grid();
  return {{"peak_cd", form.candela},
          {"axial_cd", form.punctual.photometric},
          {"ies_file", ies ? Node(ies->name) : Node()},
          {"flux_lm", form.lumens},
          {"planes", grid.horizontal_deg.size()},
          {"angles", grid.vertical_deg.size()}};
}

// What the cards would get of a panorama that an engine turns or mirrors, for whoever looks at a
// picture.
Node PanoramaNode(const Rig& rig, const std::vector<PresetLight>& lights) {
  const auto dome = std::ranges::find_if(
      lights, [](const PresetLight& light) { return light.environment != nullptr; });
  if (dome == lights.end()) return {};
  Vec3 rest{};
  for (const PresetLight& light : lights) {
    if (&light == &*dome) continue;
    const double lux = IlluminanceAt(light, rig.cards[0].centre_m, rig.normal).value();
    const EmittedColor& color = light.color();
    const Rgb& rgb = color.max_normalised;
    rest = rest + Vec3{rgb.r, rgb.g, rgb.b} * (lux / color.luminance);
  }
  Node turns = Node::Table();
  const auto ways = MistakenTurns();
  const auto seen = IrradianceIfTurned(*dome->environment, rig.normal);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    Node list = Node::Array();
    for (const Vec3& rgb : seen[i]) list.items.push_back(NodeOf(rgb * dome->engine_factor));
    turns.Put(ways[i].word, std::move(list));
  }
  return {
      {"light", dome->name()}, {"others_rgb_lx", NodeOf(rest)}, {"if_rgb_lx", std::move(turns)}};
}

Node PresetNode(const FittedLight& lamp, const PresetLight& form, std::size_t index,
                const std::vector<Derivation>& derivations, double exposure,
                const std::optional<PresetFile>& ies) {
  Node derived = Node::Table();
  for (const Derivation& derivation : derivations) {
    derived.Put(derivation.target, DerivedNode(derivation.lights[index]));
  }
  return {{"name", lamp.name},
          {"kind", LightKindName(lamp.kind)},
          {"photometry", Photometry(lamp)},
          {"color", Color(lamp, form.color())},
          {"geometry", Geometry(lamp)},
          {"fit", Fit(lamp.fit)},
          {"pre_exposed", PreExposedNode(form, exposure)},
          {"distribution", Distribution(form, ies)},
          {"derived", Node::UnlessEmpty(std::move(derived))}};
}

}  // namespace

Result<Preset> ExportJson(const LightFile& lights, const std::string& stem,
                          const PresetOptions& options) {
  Preset preset;
  const auto punctual = PunctualLightsFrom(lights, preset.warnings, options.color);
  if (!punctual) return tl::unexpected(punctual.error());
  Warnings said_already;
  PresetOptions of_lamps = options;  // as measured, whatever an engine makes of them
  of_lamps.engine = nullptr;
  const auto forms = PresetLightsFrom(lights, kEveryForm, of_lamps, said_already);
  if (!forms) return tl::unexpected(forms.error());
  const Rig rig = BuildRig(lights, *forms, options.rig_place);
  Node rig_node = NodeOf(rig);
  rig_node.Put("panorama", PanoramaNode(rig, *forms));
  const auto derivations = Derivations(lights, stem, options);
  const auto ies = IesFiles(lights, stem, EveryText(Written::kFigures));
  if (!ies) return tl::unexpected(ies.error());
  const std::string name = preset_text::SceneStem(stem, options);
  Node list = Node::Array();
  for (std::size_t i = 0; i < forms->size(); ++i) {
    const PresetLight& form = (*forms)[i];
    list.items.push_back(
        PresetNode(lights.lights[i], form, i, derivations, rig.exposure.scale, (*ies)[i]));
    WarnOfHalfFloats(form, rig.exposure.scale, preset.warnings);
  }
  auto text = JsonText({{"schema", "lightcal.preset/1"},
                        {"name", name},
                        {"lights", std::move(list)},
                        {"exposure", NodeOf(rig.exposure)},
                        {"rig", std::move(rig_node)},
                        {"provenance", NodeOf(lights.provenance)}},
                       name + ".preset.json");
  if (!text) return Propagate(std::move(text));
  preset.files.push_back({name + ".preset.json", std::move(*text)});
  return preset;
}

}  // namespace lightcal
