// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/export_targets.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "lightcal/core/file_stem.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/printable.h"
#include "lightcal/presets/into_scene.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/presets/preset_text.h"
#include "lightcal/presets/rig.h"

namespace lightcal {
namespace {

Result<std::vector<PresetTarget>> ChosenTargets(const std::vector<std::string>& names) {
  const auto all = PresetTargets();
  std::vector<PresetTarget> chosen;
  if (names.empty()) {
    std::ranges::copy_if(all, std::back_inserter(chosen),
                         [](const PresetTarget& target) { return !target.only_if_named; });
  }
  for (const std::string& name : names) {
    const auto target = FindPresetTarget(name);
    if (!target) return tl::unexpected(target.error());
    const bool repeated =
        std::ranges::any_of(chosen, [&](const PresetTarget& t) { return t.name == target->name; });
    if (!repeated) chosen.push_back(*target);
  }
  return chosen;
}

// Of targets that set lights that are there.
Result<std::vector<PresetTarget>> TargetsInto(const std::vector<std::string>& names,
                                              std::vector<PresetTarget> chosen) {
  const auto cannot = [](const PresetTarget& target) { return !target.into_scene; };
  const auto first = std::ranges::find_if(chosen, cannot);
  if (!names.empty() && first != chosen.end()) {
    std::vector<PresetTarget> able(PresetTargets().begin(), PresetTargets().end());
    std::erase_if(able, cannot);
    return Refused("into_unsupported", std::string(first->name),
                   "sets no lights of a scene that is there; {preset.into} does for " +
                       Joined(able, ", ", &PresetTarget::name));
  }
  std::erase_if(chosen, cannot);
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
  constexpr std::array<std::string_view, 6> kOfOneFormat = {
      "no_distribution",  "cone_profile",       "cone_clipped",
      "ies_not_portable", "ies_by_script_only", "picture_by_script_only"};
  std::erase_if(warnings, [&](const Warning& w) {
    if (std::ranges::find(kOfOneFormat, w.code) != kOfOneFormat.end()) return true;
    return w.code == "substituted" && std::ranges::any_of(said, [&](const Warning& earlier) {
             return earlier.code == w.code && earlier.subject == w.subject;
           });
  });
}

// What a lamp becomes in some formats and not in others: said by their names.
bool IsOfAFormat(const Warning& w) { return w.code == "substituted" || w.code == "cone_profile"; }

// What was said of a lamp's substitute, and by which formats.
struct Substituted {
  std::string code, lamp, message;
  double strays = 0.0;
  std::vector<std::string_view> formats;
};

void NoteSubstitutes(std::string_view format, const Warnings& warnings,
                     std::vector<Substituted>& said) {
  for (const Warning& w : warnings) {
    if (!IsOfAFormat(w)) continue;
    const auto known = std::ranges::find_if(said, [&](const Substituted& one) {
      return one.code == w.code && one.lamp == w.subject && one.message == w.message;
    });
    if (known == said.end()) {
      said.push_back({w.code, w.subject, w.message, w.strays, {format}});
    } else if (known->formats.back() != format) {
      known->formats.push_back(format);
    }
  }
}

// Each by the names of the formats it is true of; of formats nobody asked for by name, of a lamp
// the one that strays most.
void SayOfWhich(const std::vector<Substituted>& said, bool only_worst, Warnings& warnings) {
  for (Warning& w : warnings) {
    if (!IsOfAFormat(w)) continue;
    const Substituted* told = nullptr;
    for (const Substituted& one : said) {
      if (one.code != w.code || one.lamp != w.subject) continue;
      const bool better =
          only_worst ? told == nullptr || one.strays > told->strays : one.message == w.message;
      if (better) told = &one;
    }
    if (told != nullptr) w.message = Joined(told->formats, ", ") + ": " + told->message;
  }
}

// Of engines that light matt surfaces by nine harmonics: how far those stray from each panorama.
Warnings HarmonicsErrors(const LightFile& lights, const PresetOptions& options) {
  Warnings said;
  for (std::size_t i = 0; i < std::min(lights.lights.size(), options.environments.size()); ++i) {
    if (lights.lights[i].kind != LightKind::kDome || !options.environments[i]) continue;
    preset_text::WarnOfHarmonics(lights.lights[i].name, *options.environments[i], said);
  }
  return said;
}

// Two targets may bring the same photometric file, with the same contents.
void KeepFirstOfEachName(std::vector<PresetFile>& files) {
  std::set<std::string> names;
  std::erase_if(files, [&](const PresetFile& file) { return !names.insert(file.name).second; });
}

// Absent: the lights alone. All places are tried on the lamps as they are before anything is
// written.
Result<std::vector<std::optional<RigPlace>>> RigsOf(const LightFile& lights,
                                                    const PresetOptions& options) {
  std::vector<std::optional<RigPlace>> rigs = {std::nullopt};
  if (options.rig) rigs.emplace_back(options.rig_place);
  rigs.insert(rigs.end(), options.more_rigs.begin(), options.more_rigs.end());
  if (options.more_rigs.empty()) return rigs;
  Warnings said_by_targets;
  const auto forms = PresetLightsFrom(lights, kEveryForm, options, said_by_targets);
  if (!forms) return tl::unexpected(forms.error());
  for (const RigPlace& place : options.more_rigs) {
    auto checked = CheckRigPlace(lights, BuildRig(lights, *forms, place));
    if (!checked) return Propagate(std::move(checked));
  }
  return rigs;
}

}  // namespace

Result<ExportedPresets> ExportTargets(const LightFile& all_lights,
                                      const std::vector<std::string>& targets,
                                      const std::string& stem, const PresetOptions& asked) {
  auto chosen = ChosenTargets(targets);
  if (!chosen) return tl::unexpected(chosen.error());
  IntoLights into{all_lights, asked};
  if (!asked.into.empty()) {
    chosen = TargetsInto(targets, *std::move(chosen));
    if (!chosen) return tl::unexpected(chosen.error());
    if (auto checked = CheckInto(all_lights, asked.into); !checked) {
      return Propagate(std::move(checked));
    }
    into = OnlyInto(all_lights, asked);
  }
  const auto& [lights, options] = into;
  if (stem != FileStem(stem) || !IsPrintable(stem)) {
    return Refused("bad_name", stem, "is no stem of file names: a path, hidden, or unprintable");
  }
  ExportedPresets all;
  auto rigs = RigsOf(lights, options);
  if (!rigs) return Propagate(std::move(rigs));
  std::vector<Substituted> said;
  std::optional<Warnings> harmonics;
  CountedProgress progress(options.progress, static_cast<int>(chosen->size() * rigs->size()));
  for (const PresetTarget& target : *chosen) {
    for (const std::optional<RigPlace>& rig : *rigs) {
      PresetOptions one = options;
      one.rig = rig.has_value();
      one.rig_place = rig.value_or(RigPlace{});
      auto preset = target.exporter(lights, stem, one);
      if (!preset) return Propagate(std::move(preset));
      // What is no engine's (json) holds the lamp itself.
      if (target.place_in_report > 0) NoteSubstitutes(target.name, preset->warnings, said);
      if (target.panorama == PanoramaLaw::kNineHarmonics) {
        if (!harmonics) harmonics = HarmonicsErrors(lights, options);
        std::ranges::copy(*harmonics, std::back_inserter(preset->warnings));
      }
      progress.Done();
      if (targets.empty()) DropUnasked(all.warnings, preset->warnings);
      AddOnce(preset->warnings, all.warnings);
      std::ranges::move(preset->files, std::back_inserter(all.files));
      if (!preset->paste.empty()) {
        all.pastes.push_back(std::string(target.name) + (rig ? ", rig: " : ": ") + preset->paste);
      }
    }
  }
  SayOfWhich(said, targets.empty(), all.warnings);
  KeepFirstOfEachName(all.files);
  return all;
}

}  // namespace lightcal
