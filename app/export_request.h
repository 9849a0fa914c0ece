// SPDX-License-Identifier: Apache-2.0
// What `export` was asked, and the presets made by it.
#pragma once

#include <string>
#include <vector>

#include "console.h"
#include "lightcal/calibrate/export_presets.h"
#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

struct ExportOptions {
  std::vector<std::string> inputs;
  std::vector<std::string> targets;
  std::vector<std::string> states;
  std::string output = ".";
  std::vector<std::string> rig_at;
  std::string space, white, range, spots = "auto", renderer, into, engine;
  bool rig = false;
  bool bare = false;  // what is done anyway
  bool force = false;
};

// Wrong usage: what cannot be read. Refused: as ParseSpace, ParseWhite, EngineFrom.
[[nodiscard]] Result<PresetOptions> PresetOptionsOf(const ExportOptions& options);

struct NamedLights {
  LightFile lights;
  std::string stem;          // of its presets' names
  std::string beside = ".";  // the folder that its pictures lie in
  std::string file;          // its own name, as a page shows it
};
// Warnings of the engine file go to the console.
// Refused: as SetStates, LoadEnvironments, ExportPresets, PageWith.
[[nodiscard]] Result<ExportedPresets> PresetsOfLights(NamedLights named,
                                                      const ExportOptions& options,
                                                      const PresetOptions& preset,
                                                      Console& console);
// The same of what LightsIn takes, named after it.
[[nodiscard]] Result<ExportedPresets> PresetsOfInput(const std::string& input,
                                                     const ExportOptions& options,
                                                     const PresetOptions& preset, Console& console);

// What to paste or type to open a preset, where its directory is.
[[nodiscard]] std::string WithDirectory(std::string line, const std::string& directory);

}  // namespace lightcal::app
