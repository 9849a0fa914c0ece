// SPDX-License-Identifier: Apache-2.0
// <stem>.unreal.py, an editor script, and <stem>.t3d to paste into a level, for Unreal Engine 5:
// left-handed, Z up, centimetres, lights along +X. Candelas and lux, never lumens or nits, whose
// meaning depends on the light. Neither ran in the engine: the script runs against a strict
// stand-in of the documented names, the T3D is parsed. A dome's picture is a sky light's cubemap.
// Sources: Unreal 5.6 Python API, LightComponent.h, SkyLightComponent.h,
// TextureCompressorModule.cpp (which way a lat-long picture lies in a cubemap).
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "lightcal/colorimetry/srgb_encoding.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/control_knobs.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/frames.h"
#include "lightcal/presets/photometric_files.h"
#include "lightcal/presets/preset_text.h"
#include "lightcal/presets/scripts.h"
#include "lightcal/presets/unreal_light.h"
#include "lightcal/records/json_codec.h"

namespace lightcal {
namespace {

using OrderedJson = nlohmann::ordered_json;

// -0 is written 0.
template <std::size_t N>
OrderedJson Array(const std::array<double, N>& values) {
  OrderedJson list = OrderedJson::array();
  for (const double v : values) list.push_back(v == 0.0 ? 0.0 : v);
  return list;
}

struct Pose {
  Vec3 location_cm{};
  UnrealRotator rotation;
};

Pose PoseOf(const Vec3& forward, const Vec3& right, const Vec3& up, const Vec3& at_m) {
  const auto in = [](const Vec3& v) { return DirectionIn(EngineAxes::kZUpLeftHanded, v); };
  return {PositionIn(EngineAxes::kZUpLeftHanded, at_m),
          UnrealRotatorFromAxes(in(forward), in(right), in(up))};
}

Pose PoseOf(const PresetLight& light) {
  // A profile's C0 lies along the light's -Y.
  const double turn = light.form == LightForm::kTable ? -1.0 : 1.0;
  return PoseOf(light.aim(), light.axes.c0 * turn, light.axes.c90 * turn, light.position_m());
}

OrderedJson PoseJson(const std::string& name, const Pose& pose) {
  return {{"name", name},
          {"location_cm", Array(pose.location_cm)},
          {"pitch_yaw_roll_deg",
           Array(std::array<double, 3>{pose.rotation.pitch_deg, pose.rotation.yaw_deg,
                                       pose.rotation.roll_deg})}};
}

// ---- the script ----

// What set_state turns: candela or lux and linear colour at the reference, and the tables.
void PutControls(const PresetOptions& options, const FittedLight& lamp, const PresetLight& light,
                 const UnrealLight& unreal, OrderedJson& json) {
  const records::Node controls = KnobsNode(options, lamp, light);
  if (controls.items.empty()) return;
  double held = 1.0;
  if (!unreal.use_temperature) {
    const int* bytes = unreal.color_srgb8;
    held = Rec709Luminance(std::array{SrgbDecoded(bytes[0] / 255.0), SrgbDecoded(bytes[1] / 255.0),
                                      SrgbDecoded(bytes[2] / 255.0)});
  }
  const Rgb& linear = light.color().max_normalised;
  json["measured"] = json["properties"]["intensity"].get<double>() * held;
  json["linear"] = Array(std::array<double, 3>{linear.r, linear.g, linear.b});
  json["controls"] =
      OrderedJson::parse(records::PrintJson(controls, records::JsonLayout::kOneLine));
}

OrderedJson LightJson(const PresetLight& light, const UnrealLight& unreal,
                      const std::optional<PresetFile>& ies, const std::string& picture) {
  OrderedJson json = PoseJson(light.name(), PoseOf(light));
  json["class"] = unreal.derived.type;
  json["use_temperature"] = unreal.use_temperature;
  OrderedJson properties = OrderedJson::object();
  for (const DerivedField& field : unreal.derived.fields) {
    if (field.name != "light_color") properties[field.name] = field.values[0];
  }
  json["properties"] = std::move(properties);
  json["light_color"] = unreal.color_srgb8;
  if (light.form == LightForm::kTable && ies) json["ies"] = ies->name;
  if (!picture.empty()) json["picture"] = picture;
  if (!light.substitution.empty()) json["substituted"] = light.substitution;
  return json;
}

OrderedJson RigJson(const Rig& rig) {
  OrderedJson json = {{"exposure_bias", std::log2(rig.exposure.scale)},
                      {"ev100", std::log2(1.0 / rig.exposure.scale)},
                      {"cards", OrderedJson::array()}};
  for (const RigCard& card : rig.cards) {
    // The plane's normal is its up axis.
    OrderedJson one =
        PoseJson(card.name, PoseOf(Cross(rig.normal, rig.row), rig.row, rig.normal, card.centre_m));
    one["reflectance"] = card.reflectance;
    one["scale"] = rig.side.value();  // of a plane 100 cm wide
    json["cards"].push_back(std::move(one));
  }
  const ObjectFrame f = FrameOfCamera(EngineAxes::kZUp, rig.camera);
  OrderedJson camera = PoseJson("rig camera", PoseOf(f.z * -1.0, f.x, f.y, rig.camera.position_m));
  const double half = std::tan(rig.camera.vertical_fov.value() / 2.0) * rig.camera.aspect_ratio;
  camera["field_of_view"] = DegreesFromRadians(Radians(2.0 * std::atan(half)));
  camera["aspect_ratio"] = rig.camera.aspect_ratio;
  json["camera"] = std::move(camera);
  return json;
}

bool AllFinite(const OrderedJson& json) {
  if (json.is_number_float()) return std::isfinite(json.get<double>());
  return !json.is_structured() || std::ranges::all_of(json, &AllFinite);
}

// JSON inside a raw triple-quoted Python string.
Result<std::string> ScriptText(const OrderedJson& data, const std::string& name, Written written) {
  if (!AllFinite(data)) {
    return Failed("not_finite", name, "a number of the light is not finite; nothing exported");
  }
  if (written == Written::kFigures) return std::string();
  const std::string text = data.dump(1, ' ', true, OrderedJson::error_handler_t::replace);
  return ScriptWith("unreal.py", WithoutApostrophes(text));
}

// ---- T3D ----

// "attenuation_radius" -> "AttenuationRadius"
std::string PropertyName(const std::string& name) {
  std::string out;
  bool start = true;
  for (const char c : name) {
    if (c != '_') out += start && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    start = c == '_';
  }
  return out;
}

std::string ActorText(const std::string& id, const PresetLight& light, const UnrealLight& unreal) {
  const std::string& type = unreal.derived.type;
  const Pose pose = PoseOf(light);
  const auto triple = [](const char* a, double x, const char* b, double y, const char* c,
                         double z) {
    return std::string("(") + a + "=" + ShortestText(x) + "," + b + "=" + ShortestText(y) + "," +
           c + "=" + ShortestText(z) + ")";
  };
  std::string text = "    Begin Actor Class=/Script/Engine." + type + " Name=" + id +
                     " Archetype=/Script/Engine." + type + "'/Script/Engine.Default__" + type +
                     "'\n      Begin Object Name=\"LightComponent0\"\n";
  for (const DerivedField& field : unreal.derived.fields) {
    if (field.name == "light_color") continue;
    text += "        " + PropertyName(field.name) + "=" + ShortestText(field.values[0]) + "\n";
  }
  if (type != "DirectionalLight") text += "        IntensityUnits=Candelas\n";
  if (type == "PointLight" || type == "SpotLight") {
    text += "        bUseInverseSquaredFalloff=True\n";
  }
  text += std::string("        bUseTemperature=") + (unreal.use_temperature ? "True" : "False") +
          "\n        LightColor=(B=" + std::to_string(unreal.color_srgb8[2]) +
          ",G=" + std::to_string(unreal.color_srgb8[1]) +
          ",R=" + std::to_string(unreal.color_srgb8[0]) +
          ",A=255)\n        Mobility=Movable\n        RelativeLocation=" +
          triple("X", pose.location_cm[0], "Y", pose.location_cm[1], "Z", pose.location_cm[2]) +
          "\n        RelativeRotation=" +
          triple("Pitch", pose.rotation.pitch_deg, "Yaw", pose.rotation.yaw_deg, "Roll",
                 pose.rotation.roll_deg) +
          "\n      End Object\n      ActorLabel=" + preset_text::Quoted(light.name()) +
          "\n    End Actor\n";
  return text;
}

// Without a profile a measured beam would shine with its peak to all sides: the nearest cone.
UnrealLight WithoutProfile(const PresetLight& light, UnrealLight unreal) {
  if (light.form != LightForm::kTable || light.punctual.type != PunctualType::kSpot) return unreal;
  unreal.derived.type = "SpotLight";
  const auto [inner, outer] = UnrealAnglesOf(light.punctual.cone);
  unreal.derived.Put("inner_cone_angle", inner);
  unreal.derived.Put("outer_cone_angle", outer);
  return unreal;
}

std::string T3dText(const std::vector<PresetLight>& lights,
                    const std::vector<UnrealLight>& unreal) {
  std::string text = "Begin Map\n  Begin Level\n";
  std::set<std::string> taken;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i].form == LightForm::kDome) continue;
    text += ActorText("lightcal_" + preset_text::Identifier(lights[i].name(), taken), lights[i],
                      WithoutProfile(lights[i], unreal[i]));
  }
  return text + "  End Level\nEnd Map\n";
}

}  // namespace

Result<Preset> ExportUnreal(const LightFile& lights, const std::string& stem,
                            const PresetOptions& asked) {
  Preset preset;
  const PresetOptions options = preset_text::InRec709(asked, "unreal", preset.warnings);
  const auto forms = PresetLightsFrom(lights, kUnrealForms, options, preset.warnings);
  if (!forms) return tl::unexpected(forms.error());
  auto ies = IesFiles(lights, stem, TextsOfTables(*forms, options.written));
  if (!ies) return Propagate(std::move(ies));
  const auto refits =
      RefitLights(lights, *forms,
                  {.falloff = kUnrealFalloff, .far_range = kUnrealFarRange, .fixed = options.range},
                  preset.warnings);
  std::vector<UnrealLight> unreal;
  const std::string name = preset_text::SceneStem(stem, options);
  OrderedJson data = {{"generator", preset_text::GeneratorOf(lights)}, {"name", name}};
  data["lights"] = OrderedJson::array();
  for (std::size_t i = 0; i < forms->size(); ++i) {
    unreal.push_back(UnrealLightFrom((*forms)[i], refits[i], preset.warnings));
    preset.derived.push_back(unreal.back().derived);
    NoteRefit(refits[i], preset.derived.back());
    std::string picture;
    if ((*forms)[i].form == LightForm::kDome) {
      preset.files.push_back(preset_text::PictureFileOf(
          (*forms)[i], stem, options, preset_text::PictureEncoding::kRadiance, preset.warnings));
      picture = preset.files.back().name;
      preset_text::WarnOfHalfFloats((*forms)[i], "Unreal", preset.warnings);
      preset.warnings.push_back({"picture_by_script_only", (*forms)[i].name(),
                                 "a .t3d imports no picture: run the script"});
    }
    data["lights"].push_back(LightJson((*forms)[i], unreal.back(), (*ies)[i], picture));
    if (!options.into.empty()) {  // the light that is there may be a spot
      data["lights"].back()["cone_deg"] = Array(UnrealSpotOf((*forms)[i]));
    }
    PutControls(options, lights.lights[i], (*forms)[i], unreal.back(), data["lights"].back());
    if ((*forms)[i].form != LightForm::kTable || !(*ies)[i]) continue;
    preset.files.push_back(*(*ies)[i]);
    if (!options.into.empty()) continue;
    const bool cone = (*forms)[i].punctual.type == PunctualType::kSpot;
    preset.warnings.push_back(
        {"ies_by_script_only", (*forms)[i].name(),
         std::string("a .t3d imports no photometric file: ") +
             (cone ? "its light has the nearest cone"
                   : "its light shines with its peak to all sides") +
             "; run the script, or assign the .ies by hand to a point light"});
  }
  for (const IntoRow& row : options.into) {
    data["into"].push_back({{"lamp", row.lamp}, {"object", row.object}});
  }
  if (options.rig) data["rig"] = RigJson(BuildRig(lights, *forms, options.rig_place));
  auto script = ScriptText(data, name + ".unreal.py", options.written);
  if (!script) return Propagate(std::move(script));
  const bool sets = !options.into.empty();
  if (!options.rig && !sets && options.written != Written::kFigures) {
    preset.files.insert(preset.files.begin(), {stem + ".t3d", T3dText(*forms, unreal)});
  }
  preset.files.insert(preset.files.begin(), {name + ".unreal.py", *std::move(script)});
  preset.paste = "py \"" + std::string(kPasteDirectory) + "/" + name +
                 ".unreal.py\"   (Output Log, Cmd" +
                 (options.rig ? ": opens a level of its own)"
                  : sets      ? ")"
                              : "; pasting the .t3d into the level adds the lights, each time)");
  return preset;
}

}  // namespace lightcal
