// SPDX-License-Identifier: Apache-2.0
// lightcal export: fitted lights in, engine presets out.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>

#include "color_words.h"
#include "commands.h"
#include "input_files.h"
#include "lamp_state.h"
#include "light_input.h"
#include "lightcal/calibrate/environments.h"
#include "lightcal/calibrate/states/control_sweeps.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/presets/export_presets.h"
#include "lightcal/presets/into_scene.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/records/light_codec.h"
#include "lightcal_devices/disk_sources.h"
#include "lightcal_devices/files/delimited_text.h"
#include "one_of.h"
#include "output_files.h"
#include "page_file.h"
#include "preset_flags.h"
#include "target_words.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

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

// The JSON's stem names its presets, so two inputs of one stem would write the same files.
Result<void> CheckStems(const std::vector<std::string>& inputs) {
  std::map<std::string, std::string> seen;
  for (const std::string& input : inputs) {
    const auto [earlier, added] = seen.emplace(fs::path(input).stem().string(), input);
    if (!added) {
      return WrongUsage(input, "its presets would have the names of those of " + earlier->second +
                                   "; export them to separate directories");
    }
  }
  return {};
}

// Presets of engines, and the page that carries the lights along.
std::vector<std::string> ExportWords() {
  std::vector<std::string> words = TargetWords();
  words.emplace_back(kPageTarget);
  return words;
}

std::vector<std::string> UsdRenderers() {
  std::vector<std::string> words;
  for (const UsdReadingRow& row : UsdReadings()) words.emplace_back(row.word);
  return words;
}

// "20" or "90/180": off the axis, and round it.
Result<RigPlace> RigPlaceFrom(const std::string& word) {
  const auto slash = word.find('/');
  const auto off = ParseNumber(word.substr(0, slash));
  const auto round =
      slash == std::string::npos ? std::optional(0.0) : ParseNumber(word.substr(slash + 1));
  if (!off || !round || !(*off > 0.0 && *off <= 180.0) || !(std::abs(*round) <= 360.0)) {
    return WrongUsage("--rig-at", "\"" + word +
                                      "\" is no angle off the axis, above 0 to 180, with or "
                                      "without one round it: 20 or 90/180");
  }
  return RigPlace{*off, *round};
}

Result<PresetOptions> OptionsOf(const ExportOptions& options) {
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
  if (engine.absolute) return;
  console.Warn({"ratios_only", std::string(LightKindName(engine.kinds.front().kind)),
                "is what the engine file's factors are relative to: lamps stand right to one "
                "another, not to the exposure"});
}

Result<ExportedPresets> PresetsOfInput(const std::string& input, const ExportOptions& options,
                                       const PresetOptions& preset, Console& console) {
  auto lights = LightsIn(input);
  if (!lights) return Propagate(std::move(lights));
  auto warnings = SetStates(options.states, *lights);
  if (!warnings) return Propagate(std::move(warnings));
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(input, error);
  const bool folder = fs::is_directory(whole, error);
  const bool of_folder = !folder && whole.filename() == "session.toml";
  const fs::path named = of_folder ? whole.parent_path().filename()
                         : folder  ? whole.filename()
                                   : fs::path(input).stem();
  PresetOptions with_pictures = preset;
  const fs::path beside = folder ? fs::path(input) : fs::path(input).parent_path();
  if (preset.engine) WarnOfEngine(*preset.engine, *lights, console);
  auto pictures = LoadEnvironments(*lights, beside.string(), devices::DiskSources());
  if (!pictures) return Propagate(std::move(pictures));
  with_pictures.environments = *std::move(pictures);
  auto into = IntoOf(options.into, *lights);
  if (!into) return Propagate(std::move(into));
  with_pictures.into = *std::move(into);
  for (const FittedLight& light : lights->lights) {
    std::ranges::move(ControlSweepsOf(light), std::back_inserter(with_pictures.sweeps));
  }
  std::vector<std::string> targets = options.targets;
  const bool page = std::erase(targets, std::string(kPageTarget)) > 0;
  Result<ExportedPresets> exported = ExportedPresets{};
  if (!targets.empty() || !page) {
    exported = ExportPresets(*lights, targets, named.string(), with_pictures);
  }
  if (exported && page) {
    auto html = PageWith(*lights, fs::path(input).filename().string());
    if (!html) return Propagate(std::move(html));
    exported->files.push_back({named.string() + ".page.html", *std::move(html)});
  }
  if (exported) {
    exported->warnings.insert(exported->warnings.end(), warnings->begin(), warnings->end());
  }
  return exported;
}

std::string WithDirectory(std::string line, const std::string& directory) {
  for (std::size_t at = 0; (at = line.find(kPasteDirectory, at)) != std::string::npos;) {
    line.replace(at, kPasteDirectory.size(), directory);
    at += directory.size();
  }
  return line;
}

Result<void> RunExport(const ExportOptions& options, Console& console) {
  if (auto checked = CheckStems(options.inputs); !checked) return checked;
  if (!options.into.empty() && options.inputs.size() > 1) {
    return WrongUsage("--into", "sets the lights of one scene: export one file of lamps at a time");
  }
  const auto preset = OptionsOf(options);
  if (!preset) return tl::unexpected(preset.error());
  std::vector<OutputFile> all;
  std::vector<std::string> pastes;
  for (const std::string& input : options.inputs) {
    auto presets = PresetsOfInput(input, options, *preset, console);
    if (!presets) return Propagate(std::move(presets));
    console.Warn(presets->warnings);
    for (PresetFile& file : presets->files) {
      all.push_back({std::move(file.name), std::move(file.contents)});
    }
    for (const std::string& line : presets->pastes) {
      pastes.push_back(WithDirectory(line, options.output));
    }
  }
  PlaceUnder(options.output, all);
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (auto written = WriteOutputs(all, options.force); !written) return written;
  for (const OutputFile& file : all) console.Print("wrote " + file.path + "\n");
  if (!pastes.empty()) console.Print("\nto open them:\n");
  for (const std::string& line : pastes) console.Print("  " + line + "\n");
  console.PrintDocument({{"files", PathsOf(all)}, {"paste", Node::UnlessEmpty(pastes)}});
  return {};
}

}  // namespace

Run BuildExport(CLI::App& parser) {
  auto options = std::make_shared<ExportOptions>();
  parser.add_option("lights", options->inputs, "light.json files, as fit and run write them")
      ->required();
  parser.add_option("--to", options->targets, "Presets to write [all]")
      ->check(OneOf(ExportWords()))
      ->delimiter(',')
      ->allow_extra_args(false);
  parser.add_option("-o,--output", options->output, "Directory of the presets")
      ->capture_default_str();
  parser.add_option("--space", options->space, "Linear RGB of the colours [rec709]")
      ->check(OneOf(kSpaceWords));
  parser.add_option("--white", options->white,
                    "What the pipeline shows as white: 3200K, D65 or x,y [no adaptation]");
  parser.add_option("--range", options->range,
                    "Range of the engine's lights; intensities are refitted in it [no limit]");
  parser
      .add_option(
          "--spots", options->spots,
          "ies: spots as IES lights or projected profiles where the engine has them; cone: as "
          "its own cone, refitted; auto: as a cone where that stays within 3 % of the axial "
          "intensity")
      ->check(CLI::IsMember({"auto", "ies", "cone"}))
      ->capture_default_str();
  parser.add_option("--engine", options->engine,
                    "What the renderer makes of each kind of light, as engine learn found");
  parser
      .add_option("--renderer", options->renderer,
                  "The variant that a .usda opens with: who will render it [spec]")
      ->check(OneOf(UsdRenderers()));
  AddSceneFlags(parser, options->rig, options->bare);
  parser
      .add_option("--rig-at", options->rig_at,
                  "A rig more, its cards so many degrees off the lamp's axis and round it, facing "
                  "the lamp; of a dome the way they face, from above and from front to right: 20 "
                  "or 90/180. Pictures of several show a cone law or a turned panorama")
      ->type_name("OFF[/ROUND]")
      ->allow_extra_args(false);
  parser
      .add_option(
          "--into", options->into,
          "Set lights that are in your scene, by name (* any letters, ? one), or those of a "
          "map.csv of lines lamp,object: none is made, none is moved")
      ->type_name("PATTERN|map.csv")
      ->excludes(parser.get_option("--rig"))
      ->excludes(parser.get_option("--rig-at"));
  parser
      .add_option("--state", options->states,
                  "As the lights are where their controls say this: [LIGHT:]dimmer=18,cct_K=4500")
      ->allow_extra_args(false);
  parser.add_flag("--force", options->force, "Replace files that lightcal did not write");
  return [options](Console& console) -> Result<void> {
    if (auto parted = CheckNoTargetAmong(options->inputs); !parted) return parted;
    SpellOutAll(options->targets, !options->into.empty());
    return RunExport(*options, console);
  };
}

}  // namespace lightcal::app
