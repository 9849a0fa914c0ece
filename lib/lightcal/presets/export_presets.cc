// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/export_presets.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

#include "lightcal/core/file_stem.h"
#include "lightcal/core/printable.h"
#include "lightcal/presets/preset_table.h"

namespace lightcal {
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

// A format nobody asked for says nothing of the lights it cannot hold, and what another has said of
// a substituted lamp is not said again by each: it stands in every file and under `derived`.
void DropUnasked(const Warnings& said, Warnings& warnings) {
  constexpr std::array<std::string_view, 5> kOfOneFormat = {
      "no_distribution", "cone_profile", "cone_clipped", "ies_not_portable", "ies_by_script_only"};
  std::erase_if(warnings, [&](const Warning& w) {
    if (std::ranges::find(kOfOneFormat, w.code) != kOfOneFormat.end()) return true;
    return w.code == "substituted" && std::ranges::any_of(said, [&](const Warning& earlier) {
             return earlier.code == w.code && earlier.subject == w.subject;
           });
  });
}

// Two targets may bring the same photometric file, with the same contents.
void KeepFirstOfEachName(std::vector<PresetFile>& files) {
  std::set<std::string> names;
  std::erase_if(files, [&](const PresetFile& file) { return !names.insert(file.name).second; });
}

}  // namespace

Result<ExportedPresets> ExportPresets(const LightFile& lights,
                                      const std::vector<std::string>& targets,
                                      const std::string& stem, const PresetOptions& options) {
  const auto chosen = ChosenTargets(targets);
  if (!chosen) return tl::unexpected(chosen.error());
  if (stem != FileStem(stem) || !IsPrintable(stem)) {
    return Refused("bad_name", stem, "is no stem of file names: a path, hidden, or unprintable");
  }
  ExportedPresets all;
  std::vector<bool> scenes = {false};
  if (options.rig) scenes.push_back(true);
  for (const PresetTarget& target : *chosen) {
    for (const bool rig : scenes) {
      PresetOptions one = options;
      one.rig = rig;
      auto preset = target.exporter(lights, stem, one);
      if (!preset) return Propagate(std::move(preset));
      if (targets.empty()) DropUnasked(all.warnings, preset->warnings);
      AddOnce(preset->warnings, all.warnings);
      std::ranges::move(preset->files, std::back_inserter(all.files));
      if (!preset->paste.empty()) {
        all.pastes.push_back(std::string(target.name) + (rig ? ", rig: " : ": ") + preset->paste);
      }
    }
  }
  KeepFirstOfEachName(all.files);
  return all;
}

}  // namespace lightcal
