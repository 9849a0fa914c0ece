// SPDX-License-Identifier: Apache-2.0
// lightcal export: fitted lights in, engine presets out.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/records/light_codec.h"
#include "output_files.h"
#include "preset_files.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> inputs;
  std::vector<std::string> targets;
  std::string output = ".";
  bool bare = false;
  bool force = false;
};

std::string TargetList() {
  std::string list;
  for (const PresetTarget& target : PresetTargets()) {
    list += (list.empty() ? "" : ",") + std::string(target.name);
  }
  return list;
}

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

Result<std::vector<OutputFile>> PresetsOfInput(const std::string& input, const Options& options,
                                               Warnings& warnings) {
  const auto text = ReadWholeFile(input);
  if (!text) return tl::unexpected(text.error());
  const auto lights = LightFileFromJson(*text, input);
  if (!lights) return tl::unexpected(lights.error());
  auto files = PresetFiles(*lights, fs::path(input).stem().string(), options.targets,
                           {.bare = options.bare}, warnings);
  if (!files) return files;
  PlaceUnder(options.output, *files);
  return files;
}

Result<void> RunExport(const Options& options, Console& console) {
  if (auto checked = CheckStems(options.inputs); !checked) return checked;
  std::vector<OutputFile> all;
  for (const std::string& input : options.inputs) {
    Warnings warnings;
    auto files = PresetsOfInput(input, options, warnings);
    if (!files) return Propagate(std::move(files));
    console.Warn(warnings);
    for (OutputFile& file : *files) all.push_back(std::move(file));
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (auto written = WriteOutputs(all, options.force); !written) return written;
  nlohmann::ordered_json document = {{"files", nlohmann::ordered_json::array()}};
  for (const OutputFile& file : all) {
    console.Print("wrote " + file.path + "\n");
    document["files"].push_back(file.path);
  }
  console.PrintJson(document);
  return {};
}

}  // namespace

Run BuildExport(CLI::App& parser) {
  auto options = std::make_shared<Options>();
  parser.add_option("lights", options->inputs, "light.json files, as fit and run write them")
      ->required();
  parser.add_option("--to", options->targets, "Targets: " + TargetList() + " [all]")
      ->delimiter(',')
      ->allow_extra_args(false);
  parser.add_option("-o,--output", options->output, "Directory of the presets")
      ->capture_default_str();
  parser.add_flag("--bare", options->bare, "The lights only, no cards and camera");
  parser.add_flag("--force", options->force, "Replace files that lightcal did not write");
  return [options](Console& console) { return RunExport(*options, console); };
}

}  // namespace lightcal::app
