// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/fresh_preset.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "lightcal/presets/check/read_preset.h"

namespace lightcal {

std::optional<FreshPreset> FreshPresetOf(const PresetTarget& target, const LightFile& lights,
                                         SpotForm spots) {
  if (target.reader == nullptr) return std::nullopt;
  PresetOptions options;
  options.written = Written::kNoPictures;
  options.spots = spots;
  auto preset = target.exporter(lights, "fresh", options);
  if (!preset) return std::nullopt;
  if (target.name == "json") {  // whose distributions stand in files of another target
    const auto ies = FindPresetTarget("ies");
    if (!ies) return std::nullopt;
    auto files = ies->exporter(lights, "fresh", options);
    if (files) std::ranges::move(files->files, std::back_inserter(preset->files));
  }
  const auto named = [&](std::string_view name) {
    return std::ranges::find(preset->files, name, &PresetFile::name);
  };
  const auto beside = [&](const std::string& name) -> Result<std::string> {
    const auto found = named(name);
    if (found == preset->files.end()) return Refused("not_found", name, "is not written");
    return found->contents;
  };
  std::vector<EngineLight> lights_read;  // of a photometric file for each lamp, of all
  for (const PresetFile& file : preset->files) {
    if (!file.name.ends_with(target.ending)) continue;
    auto read = LightsOfPreset(file.name, file.contents, beside);
    if (!read) return std::nullopt;
    std::ranges::move(*read, std::back_inserter(lights_read));
  }
  if (lights_read.empty()) return std::nullopt;
  std::erase_if(preset->warnings, [](const Warning& w) {
    return w.code != "substituted" && w.code != "cone_profile";
  });
  return FreshPreset{std::move(lights_read), std::move(preset->warnings)};
}

}  // namespace lightcal
