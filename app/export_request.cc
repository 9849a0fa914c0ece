// SPDX-License-Identifier: Apache-2.0
#include "export_request.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "color_words.h"
#include "input_files.h"
#include "lamp_state.h"
#include "light_input.h"
#include "lightcal/calibrate/environments.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/presets/into_scene.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/records/light_codec.h"
#include "lightcal_devices/disk_sources.h"
#include "lightcal_devices/files/delimited_text.h"
#include "page_file.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

// "20", "90/180", "rim:20" or "rim": before which lamp, how far off its axis, and round it.
Result<RigPlace> RigPlaceFrom(const std::string& word) {
  RigPlace place;
  std::string angles = word;
  if (!ParseNumber(word.substr(0, word.find('/')))) {
    const auto colon = word.rfind(':');
    place.light = word.substr(0, colon);
    if (colon == std::string::npos) return place;
    angles = word.substr(colon + 1);
  }
  const auto slash = angles.find('/');
  const auto off = ParseNumber(angles.substr(0, slash));
  const auto round =
      slash == std::string::npos ? std::optional(0.0) : ParseNumber(angles.substr(slash + 1));
  const bool beside = off && (*off > 0.0 || (*off == 0.0 && !place.light.empty()));
  if (!beside || *off > 180.0 || !round || !(std::abs(*round) <= 360.0)) {
    return WrongUsage("--rig-at", "\"" + word +
                                      "\" is no angle off the axis, above 0 to 180, with or "
                                      "without one round it (20 or 90/180), nor a lamp with or "
                                      "without them (rim or rim:20)");
  }
  place.off_axis_deg = *off;
  place.round_deg = *round;
  return place;
}

}  // namespace

Result<PresetOptions> PresetOptionsOf(const ExportOptions& options) {
  PresetOptions preset;
  preset.rig = options.rig;
  for (const std::string& word : options.rig_at) {
    const auto place = RigPlaceFrom(word);
    if (!place) return tl::unexpected(place.error());
    preset.more_rigs.push_back(*place);
  }
  if (!options.space.empty()) {
    const auto space = ParseSpace("--space", options.space);
    if (!space) return tl::unexpected(space.error());
    preset.color.space = *space;
  }
  if (!options.white.empty()) {
    const auto white = ParseWhite("--white", options.white);
    if (!white) return tl::unexpected(white.error());
    preset.color.white = *white;
  }
  preset.spots = options.spots == "ies"    ? SpotForm::kIes
                 : options.spots == "cone" ? SpotForm::kCone
                                           : SpotForm::kAuto;
  if (!options.engine.empty()) {
    const auto text = ReadInputFile(options.engine);
    if (!text) return tl::unexpected(text.error());
    auto engine = EngineFrom(*text, options.engine);
    if (!engine) return Propagate(std::move(engine));
    preset.engine = std::make_shared<const LearntEngine>(*std::move(engine));
  }
  for (const UsdReadingRow& row : UsdReadings()) {
    if (row.word == options.renderer) preset.usd_reading = row.reading;
  }
  if (!options.range.empty()) {
    const auto range = ParseLength(options.range);
    if (!range || !(range->value() > 0.0)) {
      return WrongUsage("--range", "\"" + options.range + "\" is no length above 0, such as 20m");
    }
    preset.range = *range;
  }
  return preset;
}

namespace {

// A pattern of names, or a file of lines lamp,object.
Result<std::vector<IntoRow>> IntoOf(const std::string& into, const LightFile& lights) {
  if (into.empty()) return std::vector<IntoRow>{};
  if (!into.ends_with(".csv")) return IntoByPattern(lights, into);
  const auto bytes = ReadInputFile(into);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto text = devices::files::TextFromBytes(*bytes, into);
  if (!text) return tl::unexpected(text.error());
  std::vector<IntoRow> rows;
  const auto read = devices::files::ForEachRow(
      *text, ',', [&](int line, std::span<const std::string> cells) -> Result<void> {
        if (cells.empty() || (cells.size() == 1 && cells[0].empty())) return {};
        if (cells.size() != 2 || cells[0].empty() || cells[1].empty()) {
          return Refused("into_map", into + " line " + std::to_string(line),
                         "is no lamp,object, such as key,PropLamp_*");
        }
        if (rows.empty() && cells[0] == "lamp" && cells[1] == "object") return {};
        rows.push_back({cells[0], cells[1]});
        return {};
      });
  if (!read) return tl::unexpected(read.error());
  if (rows.empty()) return Refused("into_map", into, "has no line lamp,object");
  return rows;
}

// Which lamps an engine file says nothing of, and what it cannot say.
void WarnOfEngine(const LearntEngine& engine, const LightFile& lights, Console& console) {
  for (const FittedLight& lamp : lights.lights) {
    if (engine.Knows(lamp.kind) || lamp.kind == LightKind::kPhotometric) continue;
    console.Warn({"kind_not_learnt", lamp.name,
                  "is a " + std::string(LightKindName(lamp.kind)) +
                      ", of which the engine file says nothing; written as it is"});
  }
  if (!engine.exposure_applied) {
    console.Warn({"exposure_not_applied", "camera",
                  "has an exposure that this renderer leaves out: its samples are cd/m2"});
  }
  if (engine.absolute) return;
  console.Warn({"ratios_only", std::string(LightKindName(engine.kinds.front().kind)),
                "is what the engine file's factors are relative to: lamps stand right to one "
                "another, not to the exposure"});
}

}  // namespace

Result<ExportedPresets> PresetsOfLights(NamedLights named, const ExportOptions& options,
                                        const PresetOptions& preset, Console& console) {
  LightFile& lights = named.lights;
  auto warnings = SetStates(options.states, lights);
  if (!warnings) return Propagate(std::move(warnings));
  PresetOptions with_pictures = preset;
  if (preset.engine) WarnOfEngine(*preset.engine, lights, console);
  auto pictures = LoadEnvironments(lights, named.beside, devices::DiskSources());
  if (!pictures) return Propagate(std::move(pictures));
  with_pictures.environments = *std::move(pictures);
  auto into = IntoOf(options.into, lights);
  if (!into) return Propagate(std::move(into));
  with_pictures.into = *std::move(into);
  std::vector<std::string> targets = options.targets;
  const bool page = std::erase(targets, std::string(kPageTarget)) > 0;
  Result<ExportedPresets> exported = ExportedPresets{};
  if (!targets.empty() || !page)
    exported = ExportPresets(lights, targets, named.stem, with_pictures);
  if (exported && page) {
    auto html = PageWith(lights, named.file);
    if (!html) return Propagate(std::move(html));
    exported->files.push_back({named.stem + ".page.html", *std::move(html)});
  }
  if (exported) {
    exported->warnings.insert(exported->warnings.end(), warnings->begin(), warnings->end());
  }
  return exported;
}

Result<ExportedPresets> PresetsOfInput(const std::string& input, const ExportOptions& options,
                                       const PresetOptions& preset, Console& console) {
  auto lights = LightsIn(input);
  if (!lights) return Propagate(std::move(lights));
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(input, error);
  const bool folder = fs::is_directory(whole, error);
  const bool of_folder = !folder && whole.filename() == "session.toml";
  const fs::path named = of_folder ? whole.parent_path().filename()
                         : folder  ? whole.filename()
                                   : fs::path(input).stem();
  const fs::path beside = fs::path(LightFileAt(input).value_or(input)).parent_path();
  return PresetsOfLights(
      {*std::move(lights), named.string(), beside.string(), fs::path(input).filename().string()},
      options, preset, console);
}

std::string WithDirectory(std::string line, const std::string& directory) {
  for (std::size_t at = 0; (at = line.find(kPasteDirectory, at)) != std::string::npos;) {
    line.replace(at, kPasteDirectory.size(), directory);
    at += directory.size();
  }
  return line;
}

}  // namespace lightcal::app
