// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/preset_table.h"

#include <array>
#include <vector>

#include "lightcal/core/nearest_word.h"
#include "lightcal/presets/exporters.h"

namespace lightcal {
namespace {

constexpr std::array kTargets = {
    PresetTarget{"gltf", &ExportGltf, "gltf-validator 2.0.0-dev.3.10: 0 errors, 0 warnings"},
    PresetTarget{"godot", &ExportGodot, "schema-checked, not executed in Godot"},
    PresetTarget{"mitsuba", &ExportMitsuba, "schema-checked, not executed in Mitsuba"},
    PresetTarget{"pbrt", &ExportPbrt, "schema-checked, not executed in pbrt"},
    PresetTarget{"unity", &ExportUnity, "compiled against stand-ins, not executed in Unity"},
    PresetTarget{"unreal", &ExportUnreal, "run against a strict stand-in, not executed in Unreal"},
    PresetTarget{"usd", &ExportUsd, "tinyusdz 0.9.0-rc10 loads it; not executed in a renderer"},
    PresetTarget{"json", &ExportJson, "JSON Schema 2020-12 lightcal.preset/1"},
    PresetTarget{"blender", &ExportBlender, "rendered in Cycles 3.4: lux within 0.5 %"},
    PresetTarget{"three", &ExportThree, "rendered in three.js 0.187 and Babylon.js 9.34: 0.2 %"},
    PresetTarget{"filament", &ExportFilament, "rendered in Filament 1.53.4: lux within 2 %"},
    PresetTarget{"ies", &ExportIes, "three.js 0.187 IESLoader: texels within 1e-5 of the peak"},
    PresetTarget{"ldt", &ExportLdt, "our own reader, and through it the .ies"},
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

}  // namespace lightcal
