// SPDX-License-Identifier: Apache-2.0
// lightcal export: fitted lights in, engine presets out.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>

#include "color_words.h"
#include "commands.h"
#include "directory_name.h"
#include "export_request.h"
#include "lightcal/calibrate/export_presets.h"
#include "lightcal/presets/preset_table.h"
#include "one_of.h"
#include "output_files.h"
#include "page_file.h"
#include "preset_flags.h"
#include "progress_line.h"
#include "target_words.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

// The JSON's stem names its presets, so two inputs of one stem would write the same files.
Result<void> CheckStems(const std::vector<std::string>& inputs) {
  std::map<std::string, std::string> seen;
  for (const std::string& input : inputs) {
    const auto [earlier, added] = seen.emplace(fs::path(input).stem().string(), input);
    if (!added) {
      return WrongUsage(input, "its presets would have the names of those of " + earlier->second +
                                   "; name the sessions (lightcal export a b), whose "
                                   "presets have theirs, or export them to separate directories");
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

Result<void> RunExport(const ExportOptions& options, Console& console) {
  if (auto checked = CheckStems(options.inputs); !checked) return checked;
  if (!options.into.empty() && options.inputs.size() > 1) {
    return WrongUsage("--into", "sets the lights of one scene: export one file of lamps at a time");
  }
  auto preset = PresetOptionsOf(options);
  if (!preset) return tl::unexpected(preset.error());
  ProgressLine progress("writing presets", !console.quiet());
  std::vector<OutputFile> all;
  std::vector<std::string> pastes;
  for (const std::string& input : options.inputs) {
    if (options.inputs.size() > 1) progress.Begin("writing presets of " + input);
    preset->progress = progress.Watcher();
    auto presets = PresetsOfInput(input, options, *preset, console);
    if (!presets) return Propagate(std::move(presets));
    progress.Wipe();
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
      ->check(DirectoryName())
      ->capture_default_str();
  parser.add_option("--space", options->space, "Linear RGB of the colours [rec709]")
      ->check(OneOf(kSpaceWords));
  parser.add_option(
      "--white", options->white,
      "What the pipeline shows as white, adapted (Bradford) to the space's own: 3200K, D65 or "
      "x,y; 0.32168,0.33767 with acescg adapts nothing [D65]");
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
                  "or 90/180; or before another of several lamps: rim or rim:20. Pictures of "
                  "several show a cone law, a turned panorama, or which lamp is wrong")
      ->type_name("[LIGHT:]OFF[/ROUND]")
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
