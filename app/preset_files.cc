// SPDX-License-Identifier: Apache-2.0
#include "preset_files.h"

#include <algorithm>
#include <set>

#include "lightcal/presets/preset_table.h"

namespace lightcal::app {
namespace {

Result<std::vector<PresetTarget>> ChosenTargets(const std::vector<std::string>& names) {
  const auto all = PresetTargets();
  if (names.empty()) return std::vector<PresetTarget>(all.begin(), all.end());
  std::vector<PresetTarget> chosen;
  for (const std::string& name : names) {
    const auto target = FindPresetTarget(name);
    if (!target) return tl::unexpected(target.error());
    const bool repeated =
        std::ranges::any_of(chosen, [&](const PresetTarget& t) { return t.name == target->name; });
    if (!repeated) chosen.push_back(*target);
  }
  return chosen;
}

void AddOnce(const Warnings& from, Warnings& to) {
  for (const Warning& warning : from) {
    const bool known = std::ranges::any_of(to, [&](const Warning& w) {
      return w.code == warning.code && w.subject == warning.subject && w.message == warning.message;
    });
    if (!known) to.push_back(warning);
  }
}

// Two targets may bring the same photometric file, with the same contents.
void KeepFirstOfEachName(std::vector<OutputFile>& files) {
  std::set<std::string> names;
  std::erase_if(files, [&](const OutputFile& file) { return !names.insert(file.path).second; });
}

}  // namespace

Result<PresetOutputs> PresetFiles(const LightFile& lights, const std::string& stem,
                                  const std::vector<std::string>& targets,
                                  const PresetOptions& options, Warnings& warnings) {
  const auto chosen = ChosenTargets(targets);
  if (!chosen) return tl::unexpected(chosen.error());
  PresetOutputs outputs;
  for (const PresetTarget& target : *chosen) {
    auto preset = target.exporter(lights, stem, options);
    if (!preset) return Propagate(std::move(preset));
    // A format nobody asked for says nothing of the lights it cannot hold.
    if (targets.empty()) {
      std::erase_if(preset->warnings, [](const Warning& w) { return w.code == "no_distribution"; });
    }
    AddOnce(preset->warnings, warnings);
    for (PresetFile& file : preset->files) {
      outputs.files.push_back({std::move(file.name), std::move(file.contents)});
    }
    if (!preset->paste.empty()) {
      outputs.pastes.push_back(std::string(target.name) + ": " + preset->paste);
    }
  }
  KeepFirstOfEachName(outputs.files);
  return outputs;
}

void PlaceUnder(const std::string& directory, PresetOutputs& outputs) {
  PlaceUnder(directory, outputs.files);
  for (std::string& line : outputs.pastes) {
    for (std::size_t at = 0; (at = line.find(kPasteDirectory, at)) != std::string::npos;) {
      line.replace(at, kPasteDirectory.size(), directory);
      at += directory.size();
    }
  }
}

}  // namespace lightcal::app
