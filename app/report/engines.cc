// SPDX-License-Identifier: Apache-2.0
#include "report/engines.h"

#include <algorithm>
#include <array>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/gltf_light.h"
#include "lightcal/presets/light_color.h"
#include "lightcal/presets/preset_table.h"

namespace lightcal::app {
namespace {

constexpr int kDigits = 5, kColorDigits = 4;

constexpr std::array kEngines = {
    Engine{"unreal", "Unreal Engine", ""},
    Engine{"unity", "Unity HDRP", ""},
    Engine{"godot", "Godot", ""},
    Engine{"blender", "Blender", ".blender.py"},
    Engine{"three", "three.js, Babylon.js", ".three.js"},
    Engine{"gltf", "glTF", ".gltf"},
    Engine{"filament", "Filament", ".filament.json"},
    Engine{"usd", "USD", ""},
    Engine{"mitsuba", "Mitsuba", ""},
    Engine{"pbrt", "pbrt", ""},
};

// Which field of an exported light is its brightness. The first row whose target, type ("" = any)
// and field fit.
struct NumberField {
  std::string_view target, type, field, label, unit;
};
constexpr std::array kNumberFields = {
    NumberField{"unreal", "DirectionalLight", "intensity", "Intensity", "lx"},
    NumberField{"unreal", "", "intensity", "Intensity", "cd"},
    NumberField{"unity", "Directional", "intensity", "Intensity", "lx"},
    NumberField{"unity", "Rectangle", "intensity", "Intensity", "nits"},
    NumberField{"unity", "", "intensity", "Intensity", "cd"},
    NumberField{"godot", "", "light_intensity_lumens", "Intensity", "lm"},
    NumberField{"godot", "", "light_intensity_lux", "Intensity", "lx"},
    NumberField{"godot", "", "background_intensity", "Background intensity", "nits"},
    NumberField{"blender", "SUN", "energy_W", "Strength", "W/m²"},
    NumberField{"blender", "", "energy_W", "Power", "W"},
    NumberField{"blender", "", "strength", "Strength", ""},
    NumberField{"three", "directional", "intensity", "intensity", "lx"},
    NumberField{"three", "rect", "intensity", "intensity", "nits"},
    NumberField{"three", "dome", "intensity", "intensity", "nits"},
    NumberField{"three", "", "intensity", "intensity", "cd"},
    NumberField{"gltf", "directional", "intensity", "intensity", "lx"},
    NumberField{"gltf", "", "intensity", "intensity", "cd"},
    NumberField{"filament", "INDIRECT", "intensity", "intensity", "nits"},
    NumberField{"filament", "", "intensity_lx", "intensity", "lx"},
    NumberField{"filament", "", "intensity_candela", "intensityCandela", "cd"},
    NumberField{"usd", "DistantLight", "intensity", "intensity", "lx"},
    NumberField{"usd", "", "intensity", "intensity", "nits"},
    NumberField{"mitsuba", "", "intensity", "intensity", ""},
    NumberField{"mitsuba", "", "irradiance", "irradiance", ""},
    NumberField{"mitsuba", "", "radiance", "radiance", ""},
    NumberField{"pbrt", "", "illuminance", "illuminance", "lx"},
    NumberField{"pbrt", "diffuse", "scale", "scale", "nits"},
    NumberField{"pbrt", "infinite", "scale", "scale", "nits"},
    NumberField{"pbrt", "", "scale", "scale", "cd"},
};

// What an engine must be told with it. Godot's light_temperature is neutral and left out.
struct NoteField {
  std::string_view field, before, after;
};
constexpr std::array kNoteFields = {
    NoteField{"temperature", "Temperature ", " K"},
    NoteField{"light_color", "Color ", " (sRGB)"},
    NoteField{"background_color", "Color ", " (sRGB)"},
    NoteField{"color", "color ", " (linear)"},
    NoteField{"rgb", "rgb ", ""},
    NoteField{"pre_exposure", "pre-exposed by ", ""},
    NoteField{"radius", "radius ", " m"},
};

// Zeros behind the point say nothing.
std::string Short(std::string text) {
  if (text.find('.') == std::string::npos || text.find('e') != std::string::npos) return text;
  while (text.ends_with('0')) text.pop_back();
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string TextOf(const DerivedField& field, int digits) {
  constexpr std::size_t kChannels = 3;  // a fourth is an opaque alpha
  std::string text;
  for (std::size_t i = 0; i < std::min(field.values.size(), kChannels); ++i) {
    text += (i == 0 ? "" : ", ") + Short(RoundedText(field.values[i], digits));
  }
  return text;
}

std::string NoteOf(const DerivedLight& light) {
  std::string note;
  for (const NoteField& row : kNoteFields) {
    const DerivedField* field = light.Find(row.field);
    if (field == nullptr) continue;
    note += (note.empty() ? "" : "; ") + std::string(row.before) + TextOf(*field, kColorDigits) +
            std::string(row.after);
  }
  if (!light.substitution.empty()) note += (note.empty() ? "" : "; ") + light.substitution;
  return note;
}

DerivedLight DerivedGltf(const PunctualLight& punctual, const FalloffRefit& refit) {
  const GltfLight gltf = GltfLightFrom(punctual, refit);
  DerivedLight derived;
  derived.type = std::string(gltf.type);
  derived.Put("intensity", gltf.intensity);
  derived.Put("color", {gltf.color[0], gltf.color[1], gltf.color[2]});
  derived.substitution = punctual.substitution;
  return derived;
}

// The glTF exporter lists nothing of its own.
std::vector<DerivedLight> DerivedGltfs(const LightFile& lights) {
  Warnings said_by_export;
  const auto punctual = PunctualLightsFrom(lights, said_by_export);
  if (!punctual) return {};
  const auto refits = RefitInGltf(lights, *punctual, {}, said_by_export);
  std::vector<DerivedLight> all;
  for (std::size_t i = 0; i < punctual->size(); ++i) {
    all.push_back(DerivedGltf((*punctual)[i], refits[i]));
  }
  return all;
}

// Unity's importer takes the colour from the light, not from its numbers.
void AddColors(const LightFile& lights, std::vector<DerivedLight>& derived) {
  for (std::size_t i = 0; i < std::min(lights.lights.size(), derived.size()); ++i) {
    Warnings said_by_export;
    const Rgb c = ColorOfLight(lights.lights[i], {}, said_by_export).max_normalised;
    derived[i].Put("color", {c.r, c.g, c.b});
  }
}

std::vector<EngineLight> ReadBack(const Engine& engine, const Preset& preset) {
  if (engine.ending.empty()) return {};
  for (const PresetFile& file : preset.files) {
    if (!file.name.ends_with(engine.ending)) continue;
    auto lights = LightsOfPreset(file.name, file.contents);
    if (lights) return *std::move(lights);
  }
  return {};
}

}  // namespace

std::span<const Engine> ReportEngines() { return kEngines; }

std::vector<EngineExport> ExportForReport(const LightFile& lights) {
  std::vector<EngineExport> all;
  for (const Engine& engine : kEngines) {
    const auto target = FindPresetTarget(engine.target);
    if (!target) continue;
    auto preset = target->exporter(lights, "report", {});
    if (!preset) continue;
    EngineExport one{&engine, target->verified, std::move(preset->derived), {}};
    one.read_back = ReadBack(engine, *preset);
    if (engine.target == "unity") AddColors(lights, one.derived);
    if (engine.target == "gltf") one.derived = DerivedGltfs(lights);
    if (one.derived.size() == lights.lights.size()) all.push_back(std::move(one));
  }
  return all;
}

std::optional<EngineNumber> NumberOf(const Engine& engine, const DerivedLight& light) {
  for (const NumberField& row : kNumberFields) {
    if (row.target != engine.target || !(row.type.empty() || row.type == light.type)) continue;
    const DerivedField* field = light.Find(row.field);
    if (field == nullptr) continue;
    return EngineNumber{light.type + " · " + std::string(row.label), TextOf(*field, kDigits),
                        std::string(row.unit), NoteOf(light)};
  }
  return std::nullopt;
}

}  // namespace lightcal::app
