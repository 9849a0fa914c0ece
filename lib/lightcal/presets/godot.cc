// SPDX-License-Identifier: Apache-2.0
// <stem>.tscn for Godot 4 with physical light units. Attenuation is written as 2 (the engine's
// default of 1 falls off with 1/d); lumens are 4 pi cd of an omni and pi cd of a spot, whatever its
// cone; the engine multiplies colours by that of light_temperature, 6500 K of which is not white.
// Sources: Godot 4.6 class reference; light_3d.cpp (_color_from_temperature); scene_forward_lights.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "lightcal/colorimetry/engine_kelvin.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/falloff_refit.h"
#include "lightcal/presets/frames.h"
#include "lightcal/presets/into_scene.h"
#include "lightcal/presets/preset_document.h"
#include "lightcal/presets/preset_text.h"
#include "lightcal/presets/scripts.h"

namespace lightcal {
namespace {

using preset_text::Identifier;
using preset_text::Numbers;
using preset_text::Quoted;

constexpr double kTemperature = 6500.0;   // the engine's default, written out
constexpr Metres kGodotFarRange{4096.0};  // rendered without loss in 4.6.3
constexpr EngineForms kGodotForms = {.sphere = true, .dome = true, .cone = EngineConeLaw::kPower};
constexpr EngineFalloff kGodotFalloff{[](Metres d, Metres r) { return GodotFalloff(d, r); }};

// ---- colour ----

// The light_color, linear, which the engine turns into the lamp's; luminance of the product.
struct GodotColor {
  Rgb written;
  double luminance = 1.0;
};

GodotColor ColorFor(const EmittedColor& color) {
  const Rgb& m = color.max_normalised;
  const Rgb tint = KrystekRgbAtUnitPeak(Kelvin(kTemperature));
  const Rgb ratio = {m.r / tint.r, m.g / tint.g, m.b / tint.b};
  const double largest = std::max({ratio.r, ratio.g, ratio.b});
  GodotColor out;
  out.written = {ratio.r / largest, ratio.g / largest, ratio.b / largest};
  out.luminance = color.luminance / largest;
  return out;
}

// ---- lights ----

double RangeOf(const FalloffRefit& refit) { return refit.range.value(); }

DerivedLight DeriveGodot(const PresetLight& light, const FalloffRefit& refit, double exposure,
                         Warnings& warnings) {
  DerivedLight out;
  out.substitution = light.substitution;
  const GodotColor color = ColorFor(light.color());
  const double per_luminance = refit.intensity_factor / color.luminance;
  const Rgb& c = color.written;
  const std::vector<double> encoded = {SrgbEncoded(c.r), SrgbEncoded(c.g), SrgbEncoded(c.b), 1.0};
  if (light.environment) {
    // Texels are cd/m2. What a sky lights goes by the square of intensity times exposure (rendered
    // in 4.6.3), what is seen of it by their product: so the product is 1, and the material's own
    // multiplier, which both follow, is the exposure.
    out.type = "Environment";
    out.Put("background_energy_multiplier", 1.0);
    out.Put("background_intensity", 1.0 / exposure);
    out.elsewhere.push_back({"panorama_energy_multiplier", {exposure}});
    out.elsewhere.push_back({"upward_lx", {light.lux}});
    warnings.push_back({"ambient_at_one_exposure", light.name(),
                        "Godot exposes the light of a sky twice: right at this file's ev100; "
                        "with any other exposure scale background_intensity by its inverse and the "
                        "sky material's energy_multiplier by it. Its blur of the sky lights some "
                        "directions a tenth too much (rendered in 4.6.3) and drops a sun that was "
                        "left in the picture: take it out as a light"});
    return out;
  }
  if (light.form == LightForm::kDome) {
    // Backgrounds know no temperature: the colour as it is. What they light knows neither intensity
    // nor exposure (rendered in 4.6.3), so the multiplier is the exposed luminance, and the
    // intensity makes nits of it for what is seen.
    const Rgb& m = light.color().max_normalised;
    out.type = "Environment";
    out.Put("background_color", {SrgbEncoded(m.r), SrgbEncoded(m.g), SrgbEncoded(m.b), 1.0});
    out.Put("background_energy_multiplier", light.nits / light.color().luminance * exposure);
    out.Put("background_intensity", 1.0 / exposure);
    warnings.push_back({"ambient_at_one_exposure", light.name(),
                        "Godot exposes no light of a plain background: right at this file's ev100; "
                        "scale background_energy_multiplier with any other exposure"});
    return out;
  }
  out.Put("light_color", encoded);
  out.Put("light_temperature", kTemperature);
  if (light.form == LightForm::kDirectional) {
    out.type = "DirectionalLight3D";
    out.Put("light_intensity_lux", light.lux * per_luminance);
    out.Put("light_angular_distance", light.angular_diameter_deg.value_or(0.0));
    return out;
  }
  if (light.form == LightForm::kSpot) {
    out.type = "SpotLight3D";
    out.Put("light_intensity_lumens",
            std::numbers::pi * light.candela * per_luminance / AxisFactor(light.cone));
    out.Put("spot_range", RangeOf(refit));
    out.Put("spot_attenuation", 2.0);
    out.Put("spot_angle", DegreesFromRadians(light.cone.cone.outer));
    out.Put("spot_angle_attenuation", 1.0 / light.cone.power);
    return out;
  }
  out.type = "OmniLight3D";
  out.Put("light_intensity_lumens", 4.0 * std::numbers::pi * light.candela * per_luminance);
  out.Put("light_size", light.radius_m);
  out.Put("omni_range", RangeOf(refit));
  out.Put("omni_attenuation", 2.0);
  return out;
}

// ---- text ----

// Transform3D takes its basis by rows.
std::string Transform(const ObjectFrame& f) {
  std::vector<double> n;
  for (int row = 0; row < 3; ++row) {
    for (const Vec3* column : {&f.x, &f.y, &f.z}) n.push_back((*column)[row]);
  }
  n.insert(n.end(), f.origin.begin(), f.origin.end());
  return "transform = Transform3D(" + Numbers(n) + ")\n";
}

std::string GodotField(const DerivedField& field) {
  if (field.values.size() == 1) return field.name + " = " + ShortestText(field.values[0]) + "\n";
  return field.name + " = Color(" + Numbers(field.values) + ")\n";
}

std::string NodeHead(const std::string& name, const std::string& type) {
  return "\n[node name=" + Quoted(name) + " type=\"" + type + "\" parent=\".\"]\n";
}

// d0 of a lamp whose place does not hold it: a dictionary entry, "" = none.
std::string OffsetEntry(const FittedLight& lamp) {
  if (!lamp.distance_offset_m) return {};
  return ",\n\"distance_offset_m\": " + ShortestText(lamp.distance_offset_m->value);
}

std::string GodotNode(const std::string& name, const FittedLight& lamp, const PresetLight& light,
                      const DerivedLight& derived) {
  std::string text =
      NodeHead(name, derived.type) + Transform(FrameOfLight(EngineAxes::kYUp, light));
  for (const DerivedField& field : derived.fields) text += GodotField(field);
  text += "shadow_enabled = true\n";
  text += "metadata/lightcal = {\n\"name\": " + Quoted(light.name()) + ",\n\"kind\": \"" +
          std::string(LightKindName(light.punctual.kind)) +
          "\",\n\"candela\": " + ShortestText(light.candela) +
          ",\n\"lux\": " + ShortestText(light.lux) + OffsetEntry(lamp);
  if (!derived.substitution.empty()) {
    text += ",\n\"substituted\": " + Quoted(derived.substitution);
  }
  text += "\n}\n";
  return text;
}

// f/16 and ISO 100 upwards with k = t S/(100 1.2 N^2) and t at most a second.
struct PhysicalExposure {
  double f_number = 16.0, shutter_s = 1.0, iso = 100.0;
};

PhysicalExposure ExposureOf(double scale) {
  PhysicalExposure out;
  out.shutter_s = 1.2 * out.f_number * out.f_number * scale;
  while (out.shutter_s > 1.0) {
    out.iso *= 2.0;
    out.shutter_s /= 2.0;
  }
  return out;
}

std::string CameraAttributes(const Rig& rig) {
  constexpr double kSensorHeight_mm = 24.0;
  const PhysicalExposure e = ExposureOf(rig.exposure.scale);
  const double focal_mm = kSensorHeight_mm / 2.0 / std::tan(rig.camera.vertical_fov.value() / 2.0);
  const double focus_m = Length(rig.camera.position_m - rig.camera.target_m);
  return "\n[sub_resource type=\"CameraAttributesPhysical\" id=\"locked_exposure\"]\n"
         "frustum_focus_distance = " +
         ShortestText(focus_m) + "\nfrustum_focal_length = " + ShortestText(focal_mm) +
         "\nfrustum_near = 0.01\nexposure_aperture = " + ShortestText(e.f_number) +
         "\nexposure_shutter_speed = " + ShortestText(1.0 / e.shutter_s) +
         "\nexposure_sensitivity = " + ShortestText(e.iso) + "\nauto_exposure_enabled = false\n";
}

std::string Materials(const Rig& rig) {
  std::string text;
  for (std::size_t i = 0; i < rig.cards.size(); ++i) {
    const double v = SrgbEncoded(rig.cards[i].reflectance);
    text += "\n[sub_resource type=\"StandardMaterial3D\" id=\"card_" + std::to_string(i) +
            "\"]\ndiffuse_mode = 1\nspecular_mode = 2\nmetallic_specular = 0.0\nroughness = 1.0\n"
            "albedo_color = Color(" +
            Numbers(std::vector<double>{v, v, v, 1.0}) + ")\n";
  }
  return text + "\n[sub_resource type=\"QuadMesh\" id=\"card\"]\nsize = Vector2(" +
         Numbers(std::vector<double>{rig.side.value(), rig.side.value()}) + ")\n";
}

std::string EnvironmentText(const DerivedLight* dome) {
  std::string text =
      std::string("\n[sub_resource type=\"Environment\" id=\"surroundings\"]\nbackground_mode = ") +
      (dome != nullptr && dome->Find("upward_lx") != nullptr ? "2\n" : "1\n");
  if (!dome) {
    return text +
           "background_color = Color(0, 0, 0, 1)\nambient_light_source = 1\n"
           "reflected_light_source = 1\ntonemap_mode = 0\n";
  }
  for (const DerivedField& field : dome->fields) text += GodotField(field);
  if (dome->Find("upward_lx") != nullptr) {
    // Its middle looks along +Z: half a turn brings it to -Z, which is our +Y.
    return text +
           "sky = SubResource(\"sky\")\nsky_rotation = Vector3(0, 3.1415927, 0)\n"
           "ambient_light_source = 3\nreflected_light_source = 2\ntonemap_mode = 0\n";
  }
  return text + "ambient_light_source = 0\nreflected_light_source = 1\ntonemap_mode = 0\n";
}

std::string RigNodes(const Rig& rig) {
  std::string text;
  for (std::size_t i = 0; i < rig.cards.size(); ++i) {
    text += NodeHead(rig.cards[i].name, "MeshInstance3D") +
            Transform(FrameOfCard(EngineAxes::kYUp, rig, rig.cards[i])) +
            "mesh = SubResource(\"card\")\nsurface_material_override/0 = SubResource(\"card_" +
            std::to_string(i) + "\")\n";
  }
  return text + NodeHead("rig camera", "Camera3D") +
         Transform(FrameOfCamera(EngineAxes::kYUp, rig.camera)) +
         "attributes = SubResource(\"locked_exposure\")\ncurrent = true\n";
}

// ---- lights that are there ----

records::Node GodotFigures(const PresetLight& light, const DerivedLight& derived,
                           const FalloffRefit& refit) {
  records::Node document = {{"name", light.name()}, {"type", derived.type}};
  for (const DerivedField& field : derived.fields) {
    const bool one = field.values.size() == 1;
    document.Put(field.name, one ? records::Node(field.values[0]) : records::Node(field.values));
  }
  if (light.form != LightForm::kDirectional) {
    document.Put("candela",
                 light.candela * refit.intensity_factor / ColorFor(light.color()).luminance);
    document.Put("range", RangeOf(refit));
  }
  return document;
}

std::string GodotScene(const LightFile& file, const std::string& stem,
                       const std::vector<PresetLight>& lights,
                       const std::vector<DerivedLight>& derived, const PresetOptions& options,
                       const std::string& picture) {
  const Rig rig = BuildRig(file, lights, options.rig_place);
  const DerivedLight* dome = nullptr;
  std::string nodes;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i].form == LightForm::kDome) {
      dome = &derived[i];
      continue;
    }
    std::string name = lights[i].name();
    // Node names hold none of . : @ / " %
    for (char& c : name)
      c = std::string_view(".:@/\"%").find(c) == std::string_view::npos ? c : '_';
    while (!taken.insert(name).second) name += "_";
    nodes += GodotNode(name, file.lights[i], lights[i], derived[i]);
  }
  std::string text = "[gd_scene format=3]\n\n; " + preset_text::GeneratorOf(file) +
                     ", not executed in Godot by this run: schema-checked.\n"
                     "; This scene ends with the line \"; end\".\n"
                     "; In project.godot, or lumens and lux are ignored:\n"
                     ";   [rendering]\n;   lights_and_shadows/use_physical_light_units=true\n";
  const bool world = options.rig || dome;
  if (!picture.empty()) {
    text += "\n[ext_resource type=\"Texture2D\" path=" + Quoted(picture) +
            " id=\"panorama\"]\n\n[sub_resource type=\"PanoramaSkyMaterial\" id=\"panorama_sky\"]\n"
            "panorama = ExtResource(\"panorama\")\nenergy_multiplier = " +
            ShortestText(rig.exposure.scale) +
            "\n\n[sub_resource type=\"Sky\" id=\"sky\"]\n"
            "sky_material = SubResource(\"panorama_sky\")\n";
  }
  if (world) text += EnvironmentText(dome);
  if (options.rig) text += CameraAttributes(rig) + Materials(rig);
  text += "\n[node name=" + Quoted(stem) + " type=\"Node3D\"]\n" +
          "metadata/ev100 = " + ShortestText(rig.exposure.ev100) +
          "\nmetadata/exposure = " + ShortestText(rig.exposure.scale) + "\n" + nodes;
  if (world) {
    text += NodeHead("surroundings", "WorldEnvironment") +
            "environment = SubResource(\"surroundings\")\n";
  }
  if (options.rig) text += RigNodes(rig);
  return text + "\n; end\n";
}

}  // namespace

Result<Preset> ExportGodot(const LightFile& lights, const std::string& stem,
                           const PresetOptions& asked) {
  Preset preset;
  const PresetOptions options = preset_text::InRec709(asked, "godot", preset.warnings);
  const auto forms = PresetLightsFrom(lights, kGodotForms, options, preset.warnings);
  if (!forms) return tl::unexpected(forms.error());
  const auto refits =
      RefitLights(lights, *forms,
                  {.falloff = kGodotFalloff, .far_range = kGodotFarRange, .fixed = options.range},
                  preset.warnings);
  const double exposure = BuildRig(lights, *forms, options.rig_place).exposure.scale;
  for (std::size_t i = 0; i < forms->size(); ++i) {
    preset.derived.push_back(DeriveGodot((*forms)[i], refits[i], exposure, preset.warnings));
    NoteRefit(refits[i], preset.derived.back());
    auto finite = preset_text::CheckFinite(preset.derived.back(), (*forms)[i].name());
    if (!finite) return Propagate(std::move(finite));
  }
  const std::string name = preset_text::SceneStem(stem, options);
  if (!options.into.empty()) {
    records::Node list = records::Node::Array();
    for (std::size_t i = 0; i < forms->size(); ++i) {
      list.items.push_back(GodotFigures((*forms)[i], preset.derived[i], refits[i]));
    }
    const auto text = JsonText(
        {{"name", stem}, {"lights", std::move(list)}, {"into", IntoNode(options.into)}}, stem);
    if (!text) return tl::unexpected(text.error());
    preset.files.push_back({stem + ".godot.gd", ScriptWith("godot.gd", *text)});
    preset.paste = "copy " + std::string(kPasteDirectory) + "/" + stem +
                   ".godot.gd into the project, open it in the script editor, File > Run";
    return preset;
  }
  std::string picture;
  for (const PresetLight& light : *forms) {
    if (!light.environment) continue;
    preset.files.push_back(preset_text::PictureFileOf(
        light, stem, options, preset_text::PictureEncoding::kRadiance, preset.warnings));
    picture = preset.files.back().name;
  }
  preset.files.insert(
      preset.files.begin(),
      {name + ".tscn", GodotScene(lights, name, *forms, preset.derived, options, picture)});
  preset.paste =
      "copy " + std::string(kPasteDirectory) + "/" + name +
      ".tscn into a project with physical light units and " +
      (options.rig ? "open it" : "drag it into your scene: written again, it is replaced");
  return preset;
}

Emission EmittedInGodot(const DerivedLight& light, LightKind /*kind*/, double /*axial_part*/) {
  const bool dome = light.type == "Environment";
  if (light.Find("upward_lx") != nullptr) return {.lux = NumberIn(light, "upward_lx")};
  const std::vector<double>& c = light.Find(dome ? "background_color" : "light_color")->values;
  const Rgb tint = dome ? Rgb{1.0, 1.0, 1.0}
                        : KrystekRgbAtUnitPeak(Kelvin(NumberIn(light, "light_temperature")));
  const double luminance = Rec709Luminance(
      Vec3{SrgbDecoded(c[0]) * tint.r, SrgbDecoded(c[1]) * tint.g, SrgbDecoded(c[2]) * tint.b});
  if (dome) {
    return {.lux = std::numbers::pi * NumberIn(light, "background_intensity") *
                   NumberIn(light, "background_energy_multiplier") * luminance};
  }
  if (light.type == "DirectionalLight3D") {
    return {.lux = NumberIn(light, "light_intensity_lux") * luminance};
  }
  const bool spot = light.type == "SpotLight3D";
  Emission out{.candela = NumberIn(light, "light_intensity_lumens") * luminance /
                          (spot ? std::numbers::pi : 4.0 * std::numbers::pi),
               .falloff = kGodotFalloff,
               .range_m = NumberIn(light, spot ? "spot_range" : "omni_range")};
  if (spot) {
    out.cone = ConeOfLaw{.law = ConeLaw::kPower,
                         .outer_rad = RadiansFromDegrees(NumberIn(light, "spot_angle")).value(),
                         .power = 1.0 / NumberIn(light, "spot_angle_attenuation")};
  }
  return out;
}

}  // namespace lightcal
