// SPDX-License-Identifier: Apache-2.0
// <stem>.three.js: one ES module for three.js and Babylon.js. With I the axial intensity, E an
// illuminance, L a luminance, Y the luminance of the max-normalised colour:
//   point, spot, measured  I/Y [cd]   directional  E/Y [lx]   rect, disk, dome  L/Y [cd/m2]
// three's spot falls smoothly (smoothstep in the cosine) from angle (1 - penumbra) to angle, so
// penumbra = 1 - inner/outer; Babylon's as glTF. A disk becomes the square of its area.
// Sources: three.js 0.187, Babylon.js 9.34, rendered (tests/engines/render).
#include <cmath>
#include <numbers>

#include "lightcal/presets/exporters.h"
#include "lightcal/presets/gltf_light.h"
#include "lightcal/presets/photometric_files.h"
#include "lightcal/presets/preset_document.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/scripts.h"

namespace lightcal {
namespace {

using records::Node;
constexpr EngineForms kThree{.rect = true, .table = true, .dome = true};

// Also what a light of another form is where the engine has no such kind.
Node Punctual(const PunctualLight& light) {
  const bool spot = light.type == PunctualType::kSpot;
  const bool directional = light.type == PunctualType::kDirectional;
  Node document = {{"intensity", light.intensity},
                   {"type", spot          ? "spot"
                            : directional ? "directional"
                                          : "point"},
                   {"unit", directional ? "lx" : "cd"}};
  if (spot) document.Put({{"inner_rad", light.cone.inner}, {"outer_rad", light.cone.outer}});
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
          {"fallback", Punctual(light.punctual)}};
}

// The mean of all C planes over the peak, at the middle of each of 720 steps of gamma.
Node RoundProfile(const IntensityTable& table) {
  constexpr int kSteps = 720;
  constexpr int kTurn = 72;
  Node profile = Node::Array();
  for (int i = 0; i < kSteps; ++i) {
    const Radians gamma((i + 0.5) * std::numbers::pi / kSteps);
    double sum = 0.0;
    for (int c = 0; c < kTurn; ++c) {
      sum += table.At(Radians(2.0 * std::numbers::pi * c / kTurn), gamma).value();
    }
    profile.items.push_back(std::round(1e6 * sum / kTurn / table.peak().intensity.value()) / 1e6);
  }
  return profile;
}

Node Measured(const PresetLight& light, const std::string& ies) {
  return {{"type", "ies"},
          {"intensity", light.candela / light.color().luminance},
          {"unit", "cd"},
          {"ies", ies},
          {"profile", RoundProfile(*light.table)},
          {"fallback", Punctual(light.punctual)}};
}

Node ThreeFigures(const PresetLight& light, const std::string& ies) {
  switch (light.form) {
    case LightForm::kRect:
      return Rectangle(light);
    case LightForm::kDome:
      return {
          {"type", "dome"}, {"intensity", light.nits / light.color().luminance}, {"unit", "cd/m2"}};
    case LightForm::kTable:
      return Measured(light, ies);
    default:
      return Punctual(light.punctual);
  }
}

Node ThreeNode(const FittedLight& lamp, const PresetLight& light, const std::string& ies) {
  const PunctualLight& p = light.punctual;
  Node document = {{"name", p.name},
                   {"color", NodeOf(p.color.max_normalised)},
                   {"position_m", NodeOf(GltfFromZUp(p.position_m))},
                   {"direction", NodeOf(GltfFromZUp(p.aim))}};
  document.Put(ThreeFigures(light, ies));
  document.Put("measured", MeasuredNode(lamp, light));
  return document;
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
  Node list = Node::Array();
  for (std::size_t i = 0; i < forms->size(); ++i) {
    const std::string table = (*ies)[i] ? (*ies)[i]->contents : std::string();
    list.items.push_back(ThreeNode(lights.lights[i], (*forms)[i], table));
    preset.derived.push_back(DerivedFrom(list.items.back()));
  }
  auto text = JsonText({{"name", stem},
                        {"lights", std::move(list)},
                        {"exposure", NodeOf(rig.exposure)},
                        {"rig", options.bare ? Node() : NodeOf(Turned(rig, GltfFromZUp))},
                        {"provenance", NodeOf(lights.provenance)}},
                       stem + ".three.js");
  if (!text) return Propagate(std::move(text));
  text->pop_back();
  preset.files.push_back({stem + ".three.js", ScriptWith("three.js", *text)});
  return preset;
}

}  // namespace lightcal
