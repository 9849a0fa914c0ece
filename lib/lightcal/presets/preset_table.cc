// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/preset_table.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "lightcal/colorimetry/engine_kelvin.h"
#include "lightcal/core/nearest_word.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

// ---- what a person types in ----

constexpr TypedNote kLinearColor{"color", "color ", " (linear)", true, TypedPart::kColor};
constexpr TypedNote kEncodedColor{"light_color", "Color ", " (sRGB)", true, TypedPart::kColor};
constexpr TypedNote kRadius{"radius", "radius ", " m", true, TypedPart::kSize};

constexpr TypedNote Cone(std::string_view field, std::string_view before, std::string_view after,
                         double factor = 1.0) {
  return {field, before, after, true, TypedPart::kCone, factor};
}
constexpr double kDegrees = 180.0 / std::numbers::pi;

constexpr TypedNote kGltfNotes[] = {kLinearColor, Cone("outerConeAngle", "outerConeAngle ", " rad"),
                                    Cone("innerConeAngle", "innerConeAngle ", " rad")};
constexpr TypedNote kThreeNotes[] = {kLinearColor, Cone("outer_rad", "outer half angle ", " rad"),
                                     Cone("inner_rad", "inner ", " rad")};
constexpr TypedNote kFilamentNotes[] = {kLinearColor, Cone("inner_rad", "spotLightCone(", " rad"),
                                        Cone("outer_rad", "", " rad)")};
constexpr TypedNote kUnityNotes[] = {kEncodedColor,
                                     Cone("spot_angle_deg", "Outer Angle ", "°"),
                                     Cone("inner_spot_percent", "Inner Angle ", " %"),
                                     {"range_m", "Range ", " m"}};
constexpr TypedNote kBlenderNotes[] = {
    kLinearColor,
    Cone("spot_size_rad", "Spot Size ", "°", kDegrees),
    Cone("spot_blend", "Blend ", ""),
    Cone("spot_size_before_4_0_rad", "before 4.0 Spot Size ", "°", kDegrees),
    Cone("spot_blend_before_4_0", "Blend ", ""),
    {"area_power_before_4_0_W", "before Blender 4.0 ", " W", true, TypedPart::kEarlierVersions},
    {"ies_strength_W", "the exported file has an IES node, of Power ", " W"}};

constexpr TypedNumber kGltfNumbers[] = {{"directional", "intensity", "intensity", "lx"},
                                        {"", "intensity", "intensity", "cd"}};
constexpr TypedNumber kGodotNumbers[] = {
    {"", "light_intensity_lumens", "Intensity", "lm"},
    {"", "light_intensity_lux", "Intensity", "lx"},
    {"", "background_intensity", "Background intensity", "nits"}};
// Its lights are born with Attenuation 1, which is 4 times too bright at 4 m, and ignore lumens
// until the project has physical units. light_temperature is neutral and left out.
constexpr std::string_view kGodotUnits = "in a project that uses physical light units";
constexpr TypedNote kGodotNotes[] = {
    {"background_energy_multiplier", "Background energy multiplier ", ""},
    kEncodedColor,
    {"background_color", "Color ", " (sRGB)", true, TypedPart::kColor},
    Cone("spot_angle", "Angle ", "°"),
    Cone("spot_angle_attenuation", "Angle Attenuation ", ""),
    {"spot_attenuation", "Attenuation ", "", true, TypedPart::kWith},
    {"omni_attenuation", "Attenuation ", "", true, TypedPart::kWith},
    {"light_intensity_lumens", kGodotUnits, "", false},
    {"light_intensity_lux", kGodotUnits, "", false},
    {"spot_range", "Range ", " m"},
    {"omni_range", "Range ", " m"}};
constexpr TypedNumber kMitsubaNumbers[] = {{"", "intensity", "intensity", ""},
                                           {"", "irradiance", "irradiance", ""},
                                           {"", "radiance", "radiance", ""}};
constexpr TypedNote kMitsubaNotes[] = {{"pre_exposure", "pre-exposed by ", ""},
                                       kRadius,
                                       Cone("cutoff_angle", "cutoff_angle ", "°"),
                                       Cone("beam_width", "beam_width ", "°")};
constexpr TypedNumber kPbrtNumbers[] = {{"", "illuminance", "illuminance", "lx"},
                                        {"diffuse", "scale", "scale", "nits"},
                                        {"infinite", "scale", "scale", "nits"},
                                        {"", "scale", "scale", "cd"}};
constexpr TypedNote kPbrtNotes[] = {{"rgb", "rgb ", "", true, TypedPart::kColor},
                                    kRadius,
                                    Cone("coneangle", "coneangle ", "°"),
                                    Cone("conedeltaangle", "conedeltaangle ", "°")};
constexpr TypedNumber kUnityNumbers[] = {{"Directional", "intensity", "Intensity", "lx"},
                                         {"Sky", "upward_lx", "Desired Lux Value", "lx"},
                                         {"Rectangle", "intensity", "Intensity", "nits"},
                                         {"", "intensity", "Intensity", "cd"}};
constexpr TypedNumber kUnrealNumbers[] = {{"DirectionalLight", "intensity", "Intensity", "lx"},
                                          {"SkyLight", "intensity", "Intensity of the cubemap", ""},
                                          {"", "intensity", "Intensity", "cd"}};
constexpr TypedNote kUnrealNotes[] = {
    {"temperature", "Temperature ", " K", true, TypedPart::kTemperature},
    kEncodedColor,
    {"ies", "with the exported .ies as its IES Texture", "", false, TypedPart::kFile},
    {"spot_angles_deg", "or of a Spot Light, whose cone angles are ", ""},
    Cone("inner_cone_angle", "Inner Cone Angle ", "°"),
    Cone("outer_cone_angle", "Outer Cone Angle ", "°"),
    {"attenuation_radius", "Attenuation Radius ", " cm"}};
constexpr TypedNumber kUsdNumbers[] = {{"DistantLight", "intensity", "intensity", "lx"},
                                       {"", "intensity", "intensity", "nits"}};
constexpr TypedNote kUsdNotes[] = {
    kLinearColor,
    kRadius,
    {"ies", "with the exported .ies (shaping:ies:file)", "", false, TypedPart::kFile},
    Cone("shaping:cone:angle", "shaping:cone:angle ", "°"),
    Cone("shaping:cone:softness", "softness ", "")};
constexpr TypedNumber kBlenderNumbers[] = {{"SUN", "energy_W", "Strength", "W/m²"},
                                           {"IES", "spot_power_W", "Power of a plain Spot", "W"},
                                           {"IES", "point_power_W", "Power of a plain Point", "W"},
                                           {"", "energy_W", "Power", "W"},
                                           {"", "strength", "Strength", ""}};
constexpr TypedNumber kThreeNumbers[] = {{"directional", "intensity", "intensity", "lx"},
                                         {"rect", "intensity", "intensity", "nits"},
                                         {"dome", "intensity", "intensity", "nits"},
                                         {"", "intensity", "intensity", "cd"}};
constexpr TypedNumber kFilamentNumbers[] = {{"INDIRECT", "intensity", "intensity", "nits"},
                                            {"", "intensity_lx", "intensity", "lx"},
                                            {"", "intensity_candela", "intensityCandela", "cd"}};

// ---- who renders it ----

constexpr Renderer kGodotRenderers[] = {{"godot"}};
constexpr Renderer kUnityRenderers[] = {{"unity"}};
constexpr Renderer kUnrealRenderers[] = {{"unreal"}};
constexpr Renderer kBlenderRenderers[] = {{"blender", PixelUnit::kWatts}};
constexpr Renderer kThreeRenderers[] = {{"three", PixelUnit::kNits}, {"babylon"}};
constexpr Renderer kFilamentRenderers[] = {{"filament"}};

constexpr std::array kTargets = {
    PresetTarget{.name = "gltf",
                 .exporter = &ExportGltf,
                 .verified = "gltf-validator 2.0.0-dev.3.10: 0 errors, 0 warnings",
                 .ending = ".gltf",
                 .reader = &ReadGltf,
                 .place_in_report = 6,
                 .title = "glTF",
                 .panorama = PanoramaLaw::kNineHarmonics,
                 .numbers = kGltfNumbers,
                 .notes = kGltfNotes},
    PresetTarget{.name = "godot",
                 .exporter = &ExportGodot,
                 .verified = "schema-checked; lamps once rendered in Godot 4.6.3: lux within 1 %",
                 .into_scene = true,
                 .ending = ".tscn",
                 .reader = &ReadGodot,
                 .place_in_report = 3,
                 .title = "Godot",
                 .emission = &EmittedInGodot,
                 .numbers = kGodotNumbers,
                 .notes = kGodotNotes,
                 .renderers = kGodotRenderers,
                 .kelvin = KelvinSetting{"godot_rgb", "Godot's linear RGB at this CCT",
                                         &KrystekRgbAtUnitPeak, "Godot"}},
    PresetTarget{.name = "mitsuba",
                 .exporter = &ExportMitsuba,
                 .verified = "schema-checked, not executed in Mitsuba",
                 .place_in_report = 9,
                 .title = "Mitsuba",
                 .panorama = PanoramaLaw::kTraced,
                 .emission = &EmittedInMitsuba,
                 .cone = EngineConeLaw::kLinearInAngle,
                 .numbers = kMitsubaNumbers,
                 .notes = kMitsubaNotes},
    PresetTarget{.name = "pbrt",
                 .exporter = &ExportPbrt,
                 .verified = "schema-checked, not executed in pbrt",
                 .place_in_report = 10,
                 .title = "pbrt",
                 .panorama = PanoramaLaw::kTraced,
                 .emission = &EmittedInPbrt,
                 .cone = EngineConeLaw::kSmooth,
                 .numbers = kPbrtNumbers,
                 .notes = kPbrtNotes},
    PresetTarget{.name = "unity",
                 .exporter = &ExportUnity,
                 .verified = "compiled against stand-ins, not executed in Unity",
                 .into_scene = true,
                 .place_in_report = 2,
                 .title = "Unity HDRP",
                 .panorama = PanoramaLaw::kNineHarmonics,
                 .emission = &EmittedInUnity,
                 .cone = EngineConeLaw::kSquared,
                 .numbers = kUnityNumbers,
                 .notes = kUnityNotes,
                 .renderers = kUnityRenderers},
    PresetTarget{.name = "unreal",
                 .exporter = &ExportUnreal,
                 .verified = "run against a strict stand-in, not executed in Unreal",
                 .into_scene = true,
                 .place_in_report = 1,
                 .title = "Unreal Engine",
                 .panorama = PanoramaLaw::kNineHarmonics,
                 .emission = &EmittedInUnreal,
                 .cone = EngineConeLaw::kSquared,
                 .numbers = kUnrealNumbers,
                 .notes = kUnrealNotes,
                 .renderers = kUnrealRenderers,
                 .kelvin = KelvinSetting{"unreal_rgb", "Unreal's linear RGB at this CCT",
                                         &KrystekRgbAtUnitY, "Unreal"}},
    PresetTarget{.name = "usd",
                 .exporter = &ExportUsd,
                 .verified = "tinyusdz 0.9.0-rc10 loads it; not executed in a renderer",
                 .into_scene = true,
                 .ending = ".usda",
                 .reader = &ReadUsd,
                 .place_in_report = 8,
                 .title = "USD",
                 .panorama = PanoramaLaw::kTraced,
                 .cone = EngineConeLaw::kSmoothInAngle,
                 .numbers = kUsdNumbers,
                 .notes = kUsdNotes},
    PresetTarget{.name = "json",
                 .exporter = &ExportJson,
                 .verified = "JSON Schema 2020-12 lightcal.preset/1",
                 .ending = ".preset.json",
                 .reader = &ReadJson},
    PresetTarget{.name = "blender",
                 .exporter = &ExportBlender,
                 .verified = "rendered in Cycles 3.4: lux within 0.5 %",
                 .into_scene = true,
                 .ending = ".blender.py",
                 .reader = &ReadBlender,
                 .place_in_report = 4,
                 .title = "Blender",
                 .panorama = PanoramaLaw::kTraced,
                 .numbers = kBlenderNumbers,
                 .notes = kBlenderNotes,
                 .renderers = kBlenderRenderers,
                 .kelvin = KelvinSetting{"blender_usdlux_rgb", "Blender's and UsdLux's at this CCT",
                                         &PlanckianRgbAtUnitY}},
    PresetTarget{.name = "blender-addon",
                 .exporter = &ExportBlenderAddon,
                 .verified = "installed, linked and rendered in Blender 3.4: lux within 0.5 %",
                 .only_if_named = true},
    PresetTarget{.name = "three",
                 .exporter = &ExportThree,
                 .verified = "rendered in three.js 0.187 and Babylon.js 9.34: 0.2 %",
                 .ending = ".three.js",
                 .reader = &ReadThree,
                 .place_in_report = 5,
                 .title = "three.js, Babylon.js",
                 .panorama = PanoramaLaw::kNineHarmonics,
                 .numbers = kThreeNumbers,
                 .notes = kThreeNotes,
                 .renderers = kThreeRenderers},
    PresetTarget{.name = "filament",
                 .exporter = &ExportFilament,
                 .verified = "rendered in Filament 1.53.4: lux within 2 %",
                 .ending = ".filament.json",
                 .reader = &ReadFilament,
                 .place_in_report = 7,
                 .title = "Filament",
                 .panorama = PanoramaLaw::kNineHarmonics,
                 .numbers = kFilamentNumbers,
                 .notes = kFilamentNotes,
                 .renderers = kFilamentRenderers},
    PresetTarget{.name = "ies",
                 .exporter = &ExportIes,
                 .verified = "three.js 0.187 IESLoader: texels within 1e-5 of the peak",
                 .ending = ".ies",
                 .reader = &ReadPhotometricTable},
    PresetTarget{.name = "ldt",
                 .exporter = &ExportLdt,
                 .verified = "our own reader, and through it the .ies",
                 .ending = ".ldt",
                 .reader = &ReadPhotometricTable},
    PresetTarget{.name = "gdtf",
                 .exporter = &ExportGdtf,
                 .verified = "GDTF 1.2 schema (xmllint); not executed in a console"},
};

}  // namespace

std::span<const PresetTarget> PresetTargets() { return kTargets; }

Result<PresetTarget> FindPresetTarget(std::string_view name) {
  std::vector<std::string_view> known;
  std::string list;
  for (const PresetTarget& target : kTargets) {
    if (target.name == name) return target;
    known.push_back(target.name);
    list += (list.empty() ? "" : ", ") + std::string(target.name);
  }
  const std::string nearest = NearestWord(name, known);
  return WrongUsage("{preset.target} " + std::string(name),
                    "is no preset target" +
                        (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?") +
                        " (there are: " + list + ")");
}

const PresetTarget* TargetOfFile(std::string_view path) {
  const auto row = std::ranges::find_if(kTargets, [&](const PresetTarget& target) {
    return target.reader != nullptr && path.ends_with(target.ending);
  });
  return row == kTargets.end() ? nullptr : &*row;
}

std::string ReadableEndings(std::string_view between) {
  std::string list;
  for (const PresetTarget& target : kTargets) {
    if (target.reader == nullptr) continue;
    if (!list.empty()) list += between;
    list += target.ending;
  }
  return list;
}

PixelUnit LinearPixelsOf(std::string_view renderer) {
  for (const PresetTarget& target : kTargets) {
    for (const Renderer& one : target.renderers) {
      if (one.word == renderer) return one.linear_pixels;
    }
  }
  return PixelUnit::kExposed;
}

std::vector<const PresetTarget*> ReportTargets() {
  std::vector<const PresetTarget*> targets;
  for (const PresetTarget& target : kTargets) {
    if (target.place_in_report > 0) targets.push_back(&target);
  }
  std::ranges::sort(targets, {}, &PresetTarget::place_in_report);
  return targets;
}

}  // namespace lightcal
