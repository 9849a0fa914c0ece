// SPDX-License-Identifier: Apache-2.0
// <stem>.three.js: one ES module for three.js and Babylon.js. With I the axial intensity, E an
// illuminance, L a luminance, Y the luminance of the max-normalised colour:
//   point, spot, measured  I/Y [cd]   directional  E/Y [lx]   rect, disk, dome  L/Y [cd/m2]
// three's spot falls smoothly (smoothstep in the cosine) from angle (1 - penumbra) to angle,
// Babylon's as glTF: a spot holds a cone for each, and where three's strays too far three projects
// the beam (SpotLight.map). A disk becomes the square of its area, a measured distribution its mean
// round the aim: Babylon has no other, three shows its C0 plane all round or, in 0.187, turns it by
// the shadow camera's up instead of C0. Sources: three.js 0.187, Babylon.js 9.34, rendered
// (tests/engines/render).
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "lightcal/presets/exporters.h"
#include "lightcal/presets/falloff_refit.h"
#include "lightcal/presets/gltf_light.h"
#include "lightcal/presets/photometric_files.h"
#include "lightcal/presets/preset_document.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/preset_text.h"
#include "lightcal/presets/scripts.h"

namespace lightcal {
namespace {

using records::Node;
constexpr EngineForms kThree{.rect = true,
                             .table = true,
                             .dome = true,
                             .cone = EngineConeLaw::kSmooth,
                             .round_tables = true,
                             .projects_spots = true};

constexpr EngineFalloff kThreeFalloff{[](Metres d, Metres r) { return ThreeJsFalloff(d, r); }};
constexpr EngineFalloff kBabylonFalloff{&GltfFalloff, WindowPower::kPlain};

// The range a person fixed, in which three's window is the square of Babylon's.
struct ThreeRange {
  double range_m = 0.0;               // 0 = none
  double three = 1.0, babylon = 1.0;  // factors on the intensity

  void PutInto(Node& document) const {
    if (!(range_m > 0.0)) return;
    document.Put({{"range_m", range_m}, {"babylon_intensity_factor", babylon / three}});
  }
};

std::vector<ThreeRange> RangesOf(const LightFile& lights, const std::vector<PresetLight>& forms,
                                 const PresetOptions& options, Warnings& warnings) {
  std::vector<ThreeRange> ranges(forms.size());
  if (!options.range) return ranges;
  Warnings same_again;
  const auto three =
      RefitLights(lights, forms, {.falloff = kThreeFalloff, .fixed = options.range}, warnings);
  const auto babylon =
      RefitLights(lights, forms, {.falloff = kBabylonFalloff, .fixed = options.range}, same_again);
  for (std::size_t i = 0; i < forms.size(); ++i) {
    if (!(three[i].range.value() > 0.0)) continue;
    ranges[i] = {three[i].range.value(), three[i].intensity_factor, babylon[i].intensity_factor};
  }
  return ranges;
}

// What three's own cone makes of it.
Node ConeNode(const EngineCone& fit) {
  return {{"inner_rad", fit.cone.inner},
          {"outer_rad", fit.cone.outer},
          {"worst_of_axial", fit.worst},
          {"flux_factor", fit.flux}};
}

// Also what a light of another form is where the engine has no such kind.
Node Punctual(const PresetLight& preset, const ThreeRange& range) {
  const PunctualLight& light = preset.punctual;
  const bool spot = light.type == PunctualType::kSpot;
  const bool directional = light.type == PunctualType::kDirectional;
  Node document = {{"intensity", light.intensity * range.three},
                   {"type", spot          ? "spot"
                            : directional ? "directional"
                                          : "point"},
                   {"unit", directional ? "lx" : "cd"}};
  range.PutInto(document);
  if (!spot) return document;
  document.Put({{"inner_rad", light.cone.inner}, {"outer_rad", light.cone.outer}});
  const std::optional<BeamProfile> beam = preset.beam    ? preset.beam
                                          : preset.table ? ProfileOf(*preset.table)
                                                         : std::nullopt;
  if (beam) document.Put("three", ConeNode(RefitCone(EngineConeLaw::kSmooth, *beam)));
  return document;
}

Node Rectangle(const PresetLight& light) {
  const Vec3 axes[] = {GltfFromZUp(light.axes.c0), GltfFromZUp(light.axes.c90),
                       GltfFromZUp(light.axes.aim * -1.0)};
  return {{"type", "rect"},
          {"intensity", light.nits / light.color().luminance},
          {"unit", "cd/m2"},
          {"width_m", light.width_m},
          {"height_m", light.height_m},
          {"axes", Node::List(axes, [](const Vec3& v) { return NodeOf(v); })},
          {"fallback", Punctual(light, {})}};
}

constexpr int kSteps = 720;
constexpr double kStepsPerUnit = 1e6;

// Over the peak, at the middle of each of 720 steps of gamma. The table is round.
Node RoundProfile(const IntensityTable& table) {
  Node profile = Node::Array();
  for (int i = 0; i < kSteps; ++i) {
    const Radians gamma((i + 0.5) * std::numbers::pi / kSteps);
    const double part = table.At(Radians(0.0), gamma).value() / table.peak().intensity.value();
    profile.items.push_back(std::round(kStepsPerUnit * part) / kStepsPerUnit);
  }
  return profile;
}

// three projects what its cone cannot show.
Node Spot(const PresetLight& light, const ThreeRange& range) {
  Node document = Punctual(light, range);
  if (!light.projected) return document;
  document.Put("projected", Node{{"half_angle_rad", light.projected->half_angle.value()},
                                 {"texels", kProjectedTexels},
                                 {"worst_of_axial", light.projected->worst}});
  return document;
}

Node Measured(const PresetLight& light, const std::string& ies, const ThreeRange& range) {
  Node document = {{"type", "ies"},
                   {"intensity", range.three * light.candela / light.color().luminance},
                   {"unit", "cd"},
                   {"ies", ies},
                   {"profile", RoundProfile(*light.table)},
                   {"fallback", Punctual(light, range)}};
  range.PutInto(document);
  return document;
}

// A picture also as its harmonics (three's LightProbe) and, for Babylon.js, its two halves.
Node DomeNode(const PresetLight& light) {
  if (!light.environment) {
    return {
        {"type", "dome"}, {"intensity", light.nits / light.color().luminance}, {"unit", "cd/m2"}};
  }
  const Harmonics harmonics = RadianceHarmonics(*light.environment, &GltfFromZUp);
  const auto halved = [&](double up) {
    return IrradianceOn(*light.environment, {0.0, 0.0, up}) * (1.0 / std::numbers::pi);
  };
  return {{"type", "dome"},
          {"intensity", 1.0},
          {"unit", "cd/m2"},
          {"upward_lx", light.lux},
          {"harmonics", Node::List(harmonics, [](const Vec3& v) { return NodeOf(v); })},
          {"above", NodeOf(halved(1.0))},
          {"below", NodeOf(halved(-1.0))}};
}

Node ThreeFigures(const PresetLight& light, const std::string& ies, const ThreeRange& range) {
  switch (light.form) {
    case LightForm::kRect:
      return Rectangle(light);
    case LightForm::kDome:
      return DomeNode(light);
    case LightForm::kTable:
      return Measured(light, ies, range);
    case LightForm::kSpot:
      return Spot(light, range);
    default:
      return Punctual(light, range);
  }
}

Node ThreeNode(const FittedLight& lamp, const PresetLight& light, const std::string& ies,
               const ThreeRange& range) {
  const PunctualLight& p = light.punctual;
  Node document = {{"name", p.name},
                   {"color", ColorNode(light)},
                   {"position_m", NodeOf(GltfFromZUp(p.position_m))},
                   {"direction", NodeOf(GltfFromZUp(p.aim))}};
  document.Put(ThreeFigures(light, ies, range));
  document.Put("measured", MeasuredNode(lamp, light));
  return document;
}

// With the tables that are shown.
LightFile AsShown(LightFile lights, const std::vector<PresetLight>& forms) {
  for (std::size_t i = 0; i < forms.size(); ++i) {
    auto& measured = lights.lights[i].distribution;
    if (measured && forms[i].table) measured->table = *forms[i].table;
  }
  return lights;
}

}  // namespace

Result<Preset> ExportThree(const LightFile& lights, const std::string& stem,
                           const PresetOptions& asked) {
  Preset preset;
  const PresetOptions options = preset_text::InRec709(asked, "three", preset.warnings);
  const auto forms = PresetLightsFrom(lights, kThree, options, preset.warnings);
  if (!forms) return tl::unexpected(forms.error());
  const auto ies = IesFiles(AsShown(lights, *forms), stem, TextsOfTables(*forms, options.written));
  if (!ies) return tl::unexpected(ies.error());
  const std::vector<ThreeRange> ranges = RangesOf(lights, *forms, options, preset.warnings);
  const Rig rig = BuildRig(lights, *forms, options.rig_place);
  const std::string name = preset_text::SceneStem(stem, options);
  Node list = Node::Array();
  std::vector<PresetFile> pictures;
  for (std::size_t i = 0; i < forms->size(); ++i) {
    const std::string table = (*ies)[i] ? (*ies)[i]->contents : std::string();
    list.items.push_back(ThreeNode(lights.lights[i], (*forms)[i], table, ranges[i]));
    if ((*forms)[i].environment) {
      pictures.push_back(preset_text::PictureFileOf(
          (*forms)[i], stem, options, preset_text::PictureEncoding::kRadiance, preset.warnings));
      list.items.back().Put("picture", pictures.back().name);
      preset_text::WarnOfHalfFloats((*forms)[i], "three.js", preset.warnings);
    }
    preset.derived.push_back(DerivedFrom(list.items.back()));
  }
  auto text = JsonText({{"name", name},
                        {"lights", std::move(list)},
                        {"exposure", NodeOf(rig.exposure)},
                        {"rig", options.rig ? NodeOf(Turned(rig, GltfFromZUp)) : Node()},
                        {"provenance", NodeOf(lights.provenance)}},
                       name + ".three.js", options.written);
  if (!text) return Propagate(std::move(text));
  if (text->ends_with('\n')) text->pop_back();
  preset.files.push_back({name + ".three.js", ScriptWith("three.js", *text)});
  std::ranges::move(pictures, std::back_inserter(preset.files));
  return preset;
}

}  // namespace lightcal
