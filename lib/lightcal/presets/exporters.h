// SPDX-License-Identifier: Apache-2.0
// The functions behind the rows of preset_table.cc, one file each.
#pragma once

#include "lightcal/presets/preset.h"

namespace lightcal {

// <stem>.gltf: glTF 2.0 text with KHR_lights_punctual (gltf.cc).
[[nodiscard]] Result<Preset> ExportGltf(const LightFile& lights, const std::string& stem,
                                        const PresetOptions& options);
// <stem>.preset.json: schema lightcal.preset/1, the canonical record (json.cc).
[[nodiscard]] Result<Preset> ExportJson(const LightFile& lights, const std::string& stem,
                                        const PresetOptions& options);

// <stem>.blender.py: a script for Blender 3.4 and later, Cycles (blender.cc).
[[nodiscard]] Result<Preset> ExportBlender(const LightFile& lights, const std::string& stem,
                                           const PresetOptions& options);
// <stem>.three.js: an ES module for three.js and Babylon.js (three.cc).
[[nodiscard]] Result<Preset> ExportThree(const LightFile& lights, const std::string& stem,
                                         const PresetOptions& options);
// <stem>.filament.json, and the same numbers as C++ in <stem>.filament.h (filament.cc).
[[nodiscard]] Result<Preset> ExportFilament(const LightFile& lights, const std::string& stem,
                                            const PresetOptions& options);

// <stem>-<light>.ies, LM-63-2002, and .ldt, EULUMDAT (photometric.cc). A light at infinity has none
// (no_distribution).
[[nodiscard]] Result<Preset> ExportIes(const LightFile& lights, const std::string& stem,
                                       const PresetOptions& options);
[[nodiscard]] Result<Preset> ExportLdt(const LightFile& lights, const std::string& stem,
                                       const PresetOptions& options);

// <stem>.tscn, Godot 4 with physical light units (godot.cc).
[[nodiscard]] Result<Preset> ExportGodot(const LightFile& lights, const std::string& stem,
                                         const PresetOptions& options);
// <stem>.usda, UsdLux in metres (usd.cc), and the .ies files it names.
[[nodiscard]] Result<Preset> ExportUsd(const LightFile& lights, const std::string& stem,
                                       const PresetOptions& options);
// <stem>.unreal.py and <stem>.t3d (unreal.cc), and the .ies files the script imports.
[[nodiscard]] Result<Preset> ExportUnreal(const LightFile& lights, const std::string& stem,
                                          const PresetOptions& options);
// <stem>.unity.json and LightcalImporter.cs (unity.cc).
[[nodiscard]] Result<Preset> ExportUnity(const LightFile& lights, const std::string& stem,
                                         const PresetOptions& options);
// <stem>.mitsuba.xml (mitsuba.cc) and <stem>.pbrt (pbrt.cc).
[[nodiscard]] Result<Preset> ExportMitsuba(const LightFile& lights, const std::string& stem,
                                           const PresetOptions& options);
[[nodiscard]] Result<Preset> ExportPbrt(const LightFile& lights, const std::string& stem,
                                        const PresetOptions& options);

}  // namespace lightcal
