// SPDX-License-Identifier: Apache-2.0
// The engines a report speaks of: what each is given, by its own names and units.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "check/engine_light.h"
#include "lightcal/presets/derived_light.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

// In the order people look for them.
struct Engine {
  std::string_view target;  // the word after --to
  std::string_view title;   // "Unreal Engine"
  std::string_view ending;  // the ending of the file that `check` reads back; "" = it cannot
};
[[nodiscard]] std::span<const Engine> ReportEngines();

// What an exporter makes of every light of a file.
struct EngineExport {
  const Engine* engine = nullptr;
  std::string_view verified;           // how its output was checked, for people
  std::vector<DerivedLight> derived;   // one a light
  std::vector<EngineLight> read_back;  // by the file's own meaning; empty where `check` cannot
};
// Engines whose exporter refuses these lights are left out.
[[nodiscard]] std::vector<EngineExport> ExportForReport(const LightFile& lights);

// The one number by which an engine's light is as bright as the lamp.
struct EngineNumber {
  std::string field;  // "PointLight · Intensity"
  std::string value;  // "8338.9"
  std::string unit;   // "cd"; "" = none
  std::string note;   // what must be set with it
};
[[nodiscard]] std::optional<EngineNumber> NumberOf(const Engine& engine, const DerivedLight& light);

}  // namespace lightcal::app
