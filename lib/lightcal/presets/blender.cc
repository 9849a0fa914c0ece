// SPDX-License-Identifier: Apache-2.0
// <stem>.blender.py: a script that brings the lights into the scene that is open in Blender 3.4 and
// later; of a rig, that builds a scene with cards, camera and exposure. With K = 683 lm/W, I the
// axial intensity, E an illuminance, L a luminance, Y the luminance of the max-normalised colour:
//   point, sphere, spot  4 pi I/(K Y)     sun    E/(K Y)
//   rect, disk           pi I/(K Y)       world  L/(K Y)
//   measured             177.83/(K Y), the candela in the IES text (Cycles turns them to watts at
//                        4 pi/177.83), mirrored: Cycles has C0 along -y and C90 along -x
// Cycles' spot falls smoothly (smoothstep) in the cosine from spot_blend's edge to spot_size;
// before 4.0, where a spot is a disc, another cosine dims it within. The script holds the cone for
// both. Sources: Cycles 3.4 and 5.2, rendered (tests/engines/render).
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/blender_sphere.h"
#include "lightcal/presets/control_knobs.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/into_scene.h"
#include "lightcal/presets/photometric_files.h"
#include "lightcal/presets/preset_document.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/preset_text.h"
#include "lightcal/presets/scripts.h"
#include "lightcal/records/light_curve.h"

namespace lightcal {
namespace {

using records::Node;
constexpr double kLumensPerWatt = 683.0;
constexpr double kLumensPerWattOfIes = 177.83;
constexpr EngineForms kBlender{.sphere = true,
                               .disk = true,
                               .rect = true,
                               .table = true,
                               .dome = true,
                               .cone = EngineConeLaw::kSmooth,
                               .spots_by_table = true};

// Says what versions before 4.0 make of a sphere; aloud where a reading was taken so close that
// this is seen.
void NoteOldSphere(const FittedLight& lamp, PresetLight& light, Warnings& warnings) {
  if (light.form != LightForm::kSphere) return;
  const double diameter_m = 2.0 * light.radius_m;
  const auto low = [&](double diameters) {
    const double lack = LackOfOldBlenderSphere(light.radius_m, diameters * diameter_m);
    return RoundedText(100.0 * lack, 2) + " %";
  };
  light.substitution = std::string(kOldBlenderSphere) + ": " + low(1.0) +
                       " low at one diameter from its centre, " + low(2.0) + " at two, " +
                       low(5.0) + " at five (" + RoundedText(5.0 * diameter_m, 3) +
                       " m); from 4.0 on right everywhere";
  const bool seen = std::ranges::any_of(lamp.residuals, [&](const ResidualRow& row) {
    const double d = row.distance_m.value_or(0.0) + SurfaceRadius_m(lamp);
    return row.distance_m && LackOfOldBlenderSphere(light.radius_m, d) > kLeastLackTold;
  });
  if (seen) warnings.push_back({"near_field", light.name(), light.substitution});
}

const char* BlenderType(LightForm form) {
  switch (form) {
    case LightForm::kSpot:
      return "SPOT";
    case LightForm::kDirectional:
      return "SUN";
    case LightForm::kRect:
    case LightForm::kDisk:
      return "AREA";
    case LightForm::kDome:
      return "WORLD";
    case LightForm::kTable:
      return "IES";
    default:
      return "POINT";
  }
}

// Watts (watts/m2 of a sun) per cd or lx of the light's own figure over K Y.
double WattsOf(const PresetLight& light) {
  const double figure = light.candela / (kLumensPerWatt * light.color().luminance);
  switch (light.form) {
    case LightForm::kDirectional:
      return light.lux / (kLumensPerWatt * light.color().luminance);
    case LightForm::kRect:
    case LightForm::kDisk:
      return std::numbers::pi * figure;
    case LightForm::kTable:
      return kLumensPerWattOfIes / kLumensPerWatt / light.punctual.color.luminance;
    default:
      return 4.0 * std::numbers::pi * figure;
  }
}

double BlendOf(const EngineCone& fit) {
  const double outer = std::cos(fit.cone.outer.value());
  return (std::cos(fit.cone.inner.value()) - outer) / (1.0 - outer);
}

// What a light with an IES node is told by itself is that node's multiplier, whatever the lamp: a
// person who types takes Blender's own light of that intensity. Before 4.0 an area light of P watts
// has P/4 on its axis, not P/pi, and a spot is dimmed by a cosine within its cone.
void PutPlainPower(const PresetLight& light, DerivedLight& out) {
  if (light.form == LightForm::kRect || light.form == LightForm::kDisk) {
    out.elsewhere.push_back({"area_power_before_4_0_W", {4.0 / std::numbers::pi * WattsOf(light)}});
  }
  if (light.form != LightForm::kTable) return;
  const PunctualLight& plain = light.punctual;
  const double watts =
      4.0 * std::numbers::pi * plain.photometric / (kLumensPerWatt * plain.color.luminance);
  const bool spot = plain.type == PunctualType::kSpot;
  out.elsewhere.push_back({spot ? "spot_power_W" : "point_power_W", {watts}});
  if (spot && light.beam) {
    out.elsewhere.push_back({"spot_size_rad", {2.0 * light.cone.cone.outer.value()}});
    out.elsewhere.push_back({"spot_blend", {BlendOf(light.cone)}});
    const EngineCone before = RefitCone(EngineConeLaw::kSmoothTimesCosine, *light.beam);
    out.elsewhere.push_back({"spot_size_before_4_0_rad", {2.0 * before.cone.outer.value()}});
    out.elsewhere.push_back({"spot_blend_before_4_0", {BlendOf(before)}});
  }
  out.elsewhere.push_back({"ies_strength_W", {WattsOf(light)}});
}

// Columns: the light's own x, y and z; it shines along -z.
Node Axes(const PresetLight& light) {
  const LampAxes& a = light.axes;
  const bool table = light.form == LightForm::kTable;
  const Vec3 columns[] = {table ? a.c90 : a.c0, table ? a.c0 * -1.0 : a.c90, a.aim * -1.0};
  return Node::List(columns, [](const Vec3& v) { return NodeOf(v); });
}

Node SpotShape(const EngineCone& fit) {
  Node shape = {{"spot_size_rad", 2.0 * fit.cone.outer.value()}, {"spot_blend", BlendOf(fit)}};
  shape.Put("worst_of_axial", fit.worst);
  shape.Put("flux_factor", fit.flux);
  return shape;
}

Node Shape(const PresetLight& light) {
  const bool disk = light.form == LightForm::kDisk;
  Node shape = Node::Table();
  switch (light.form) {
    case LightForm::kDirectional:
      return {{"angle_rad", RadiansFromDegrees(light.angular_diameter_deg.value_or(0.0))}};
    case LightForm::kRect:
    case LightForm::kDisk:
      return {{"shape", disk ? "DISK" : "RECTANGLE"},
              {"size_m", Node{disk ? 2.0 * light.radius_m : light.width_m,
                              disk ? 2.0 * light.radius_m : light.height_m}}};
    case LightForm::kSpot: {
      shape = SpotShape(light.cone);
      if (light.beam) {
        shape.Put("before_4_0",
                  SpotShape(RefitCone(EngineConeLaw::kSmoothTimesCosine, *light.beam)));
      }
      break;
    }
    default:
      break;
  }
  shape.Put("radius_m", light.form == LightForm::kSphere ? light.radius_m : 0.0);
  return shape;
}

Node BlenderNode(const FittedLight& lamp, const PresetLight& light) {
  const PunctualLight& p = light.punctual;
  Node document = {
      {"name", p.name}, {"type", BlenderType(light.form)}, {"color", ColorNode(light)}};
  if (light.form == LightForm::kDome) {
    const double nits = light.environment ? 1.0 : light.nits / p.color.luminance;  // of a texel
    document.Put("strength", nits / kLumensPerWatt);
    if (light.environment) document.Put("upward_lx", light.lux);
  } else {
    document.Put({{"energy_W", WattsOf(light)},
                  {"axes", Axes(light)},
                  {"position_m", NodeOf(p.position_m)}});
    document.Put(Shape(light));
  }
  document.Put("measured", MeasuredNode(lamp, light));
  return document;
}

// C -> 360 - C. Planes that stand for their own mirror images stay as they are.
Result<IntensityTable> MirroredInC0(const IntensityTable& table) {
  IntensityGrid grid = table.grid();
  const std::vector<double> c = grid.horizontal_deg;
  if (grid.type != GoniometerType::kC || c.size() < 2 || c.back() <= 180.0) return table;
  const std::size_t nv = grid.vertical_deg.size();
  // A turn left open at 360 keeps its first plane first.
  const bool open = c.front() == 0.0 && c.back() < 360.0;
  grid.candela.clear();
  for (std::size_t i = 0; i < c.size(); ++i) {
    const std::size_t from = open ? (c.size() - i) % c.size() : c.size() - 1 - i;
    grid.horizontal_deg[i] = open && i == 0 ? 0.0 : 360.0 - c[from];
    const auto plane = table.grid().candela.begin() + static_cast<std::ptrdiff_t>(from * nv);
    grid.candela.insert(grid.candela.end(), plane, plane + static_cast<std::ptrdiff_t>(nv));
  }
  return IntensityTable::Make(std::move(grid), "light");
}

Result<std::string> MirroredIes(const LightFile& file, const FittedLight& lamp,
                                const PresetLight& light, const std::string& stem,
                                Written written) {
  LightFile alone;
  alone.lights = {lamp};
  alone.provenance = file.provenance;
  if (lamp.distribution) {
    auto mirrored = MirroredInC0(*light.table);
    if (!mirrored) return Propagate(std::move(mirrored));
    alone.lights.front().distribution->table = *std::move(mirrored);
  }
  auto files = IesFiles(alone, stem, EveryText(written));
  if (!files) return Propagate(std::move(files));
  return files->front()->contents;
}

}  // namespace

Result<Preset> ExportBlender(const LightFile& lights, const std::string& stem,
                             const PresetOptions& options) {
  Preset preset;
  EngineForms able = kBlender;
  able.spots_by_table = options.into.empty();  // a light that is there has a cone of its own
  auto forms = PresetLightsFrom(lights, able, options, preset.warnings);
  if (!forms) return tl::unexpected(forms.error());
  for (std::size_t i = 0; i < forms->size(); ++i) {
    NoteOldSphere(lights.lights[i], (*forms)[i], preset.warnings);
  }
  const Rig rig = BuildRig(lights, *forms, options.rig_place);
  const std::string name = preset_text::SceneStem(stem, options);
  Node list = Node::Array();
  std::vector<PresetFile> pictures;
  for (std::size_t i = 0; i < forms->size(); ++i) {
    const FittedLight& lamp = lights.lights[i];
    Node document = BlenderNode(lamp, (*forms)[i]);
    preset.derived.push_back(DerivedFrom(document));
    PutPlainPower((*forms)[i], preset.derived.back());
    document.Put("controls", KnobsNode(options, lamp, (*forms)[i]));
    if ((*forms)[i].form == LightForm::kTable) {
      auto ies = MirroredIes(lights, lamp, (*forms)[i], stem, options.written);
      if (!ies) return Propagate(std::move(ies));
      document.Put("ies", *ies);
    }
    if ((*forms)[i].environment) {
      pictures.push_back(preset_text::PictureFileOf(
          (*forms)[i], stem, options, preset_text::PictureEncoding::kOpenExr, preset.warnings));
      document.Put("picture", pictures.back().name);
    }
    list.items.push_back(std::move(document));
  }
  const bool plain = options.color.space == RgbSpace::kSrgb;
  const auto text =
      JsonText({{"name", name},
                {"lumens_per_watt", kLumensPerWatt},
                {"color_space", plain ? Node() : Node(RgbSpaceWord(options.color.space))},
                {"lights", std::move(list)},
                {"exposure", NodeOf(rig.exposure)},
                {"into", IntoNode(options.into)},
                {"rig", options.rig ? NodeOf(rig) : Node()},
                {"provenance", NodeOf(lights.provenance)}},
               name + ".blender.py", options.written);
  if (!text) return tl::unexpected(text.error());
  preset.files.push_back(
      {name + ".blender.py", ScriptWith("blender.py", WithoutApostrophes(*text))});
  std::ranges::move(pictures, std::back_inserter(preset.files));
  preset.paste = (options.into.empty() ? "blender -P " : "blender YOURS.blend -P ") +
                 std::string(kPasteDirectory) + "/" + name + ".blender.py";
  const bool dome = std::ranges::any_of(
      *forms, [](const PresetLight& light) { return light.form == LightForm::kDome; });
  if (dome && !options.rig) {
    preset.paste +=
        "   (a scene with a world of its own, as Blender's start-up scene has, keeps "
        "it: choose \"lightcal " +
        name + "\" in World properties)";
  }
  return preset;
}

}  // namespace lightcal
