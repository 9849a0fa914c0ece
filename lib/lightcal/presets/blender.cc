// SPDX-License-Identifier: Apache-2.0
// <stem>.blender.py: a script that builds the lights, the rig and the exposure in Blender 3.4 and
// later. With K = 683 lm/W, I the axial intensity, E an illuminance, L a luminance, Y the luminance
// of the max-normalised colour:
//   point, sphere, spot  4 pi I/(K Y)     sun    E/(K Y)
//   rect, disk           pi I/(K Y)       world  L/(K Y)
//   measured             177.83/(K Y), the candela in the IES text (Cycles turns them to watts at
//                        4 pi/177.83), mirrored: Cycles has C0 along -y and C90 along -x
// Cycles' spot falls smoothly (smoothstep) in the cosine from spot_blend's edge to spot_size.
// Sources: Cycles 3.4 and 5.2, rendered (tests/engines/render).
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "lightcal/presets/exporters.h"
#include "lightcal/presets/photometric_files.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/rig_pieces.h"
#include "lightcal/presets/scripts.h"

namespace lightcal {
namespace {

using Json = nlohmann::ordered_json;
using json_pieces::Array;

constexpr double kLumensPerWatt = 683.0;
constexpr double kLumensPerWattOfIes = 177.83;
constexpr EngineForms kBlender{
    .sphere = true, .disk = true, .rect = true, .table = true, .dome = true};

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

Json Axes(const Vec3& x, const Vec3& y, const Vec3& z) {
  return {Array<Json>(x), Array<Json>(y), Array<Json>(z)};
}

void AddShape(const PresetLight& light, Json& json) {
  const PunctualLight& p = light.punctual;
  const bool disk = light.form == LightForm::kDisk;
  switch (light.form) {
    case LightForm::kDirectional:
      json["angle_rad"] = RadiansFromDegrees(light.angular_diameter_deg.value_or(0.0)).value();
      return;
    case LightForm::kRect:
    case LightForm::kDisk:
      json["shape"] = disk ? "DISK" : "RECTANGLE";
      json["size_m"] = {disk ? 2.0 * light.radius_m : light.width_m,
                        disk ? 2.0 * light.radius_m : light.height_m};
      return;
    case LightForm::kSpot: {
      const double outer = std::cos(p.cone.outer.value());
      json["spot_size_rad"] = 2.0 * p.cone.outer.value();
      json["spot_blend"] = (std::cos(p.cone.inner.value()) - outer) / (1.0 - outer);
      break;
    }
    default:
      break;
  }
  json["radius_m"] = light.form == LightForm::kSphere ? light.radius_m : 0.0;
}

Json LightJson(const FittedLight& lamp, const PresetLight& light) {
  const PunctualLight& p = light.punctual;
  Json json = {{"name", p.name}, {"type", BlenderType(light.form)}};
  const Rgb& c = p.color.max_normalised;
  json["color"] = {c.r, c.g, c.b};
  if (light.form == LightForm::kDome) {
    json["strength"] = light.nits / (kLumensPerWatt * p.color.luminance);
  } else {
    json["energy_W"] = WattsOf(light);
    // Columns: the light's own x, y and z; it shines along -z.
    const LampAxes& a = light.axes;
    const Vec3 back = a.aim * -1.0;
    json["axes"] =
        light.form == LightForm::kTable ? Axes(a.c90, a.c0 * -1.0, back) : Axes(a.c0, a.c90, back);
    json["position_m"] = Array<Json>(p.position_m);
    AddShape(light, json);
  }
  json["measured"] = json_pieces::MeasuredJson<Json>(lamp, light);
  return json;
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
                                const PresetLight& light, const std::string& stem) {
  auto mirrored = MirroredInC0(*light.table);
  if (!mirrored) return Propagate(std::move(mirrored));
  LightFile alone;
  alone.lights = {lamp};
  alone.provenance = file.provenance;
  alone.lights.front().distribution->table = *std::move(mirrored);
  auto files = IesFiles(alone, stem);
  if (!files) return Propagate(std::move(files));
  return files->front()->contents;
}

Result<Json> LightsJson(const LightFile& file, const std::vector<PresetLight>& lights,
                        const std::string& stem) {
  Json list = Json::array();
  for (std::size_t i = 0; i < lights.size(); ++i) {
    Json json = LightJson(file.lights[i], lights[i]);
    if (lights[i].form == LightForm::kTable) {
      auto ies = MirroredIes(file, file.lights[i], lights[i], stem);
      if (!ies) return Propagate(std::move(ies));
      json["ies"] = *std::move(ies);
    }
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace

Result<Preset> ExportBlender(const LightFile& lights, const std::string& stem,
                             const PresetOptions& options) {
  Preset preset;
  const auto forms = PresetLightsFrom(lights, kBlender, options, preset.warnings);
  if (!forms) return tl::unexpected(forms.error());
  const Rig rig = BuildRig(lights, *forms);
  auto list = LightsJson(lights, *forms, stem);
  if (!list) return Propagate(std::move(list));
  Json root = {{"name", stem}, {"lumens_per_watt", kLumensPerWatt}};
  root["lights"] = *std::move(list);
  for (const Json& light : root["lights"]) {
    preset.derived.push_back(json_pieces::DerivedFrom(light));
  }
  root["exposure"] = json_pieces::ExposureJson<Json>(rig.exposure);
  if (!options.bare) root["rig"] = json_pieces::RigJson<Json>(rig);
  root["provenance"] = json_pieces::ProvenanceJson<Json>(lights.provenance);
  const auto text = json_pieces::TextOf(root, stem + ".blender.py");
  if (!text) return tl::unexpected(text.error());
  preset.files.push_back(
      {stem + ".blender.py", ScriptWith("blender.py", WithoutApostrophes(*text))});
  preset.paste = "blender -P " + std::string(kPasteDirectory) + "/" + stem + ".blender.py";
  return preset;
}

}  // namespace lightcal
