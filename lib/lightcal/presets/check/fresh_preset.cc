// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/fresh_preset.h"

#include <algorithm>
#include <string>
#include <utility>

#include "lightcal/presets/check/read_preset.h"

namespace lightcal {

std::optional<FreshPreset> FreshPresetOf(const PresetTarget& target, const LightFile& lights,
                                         SpotForm spots) {
  if (target.reader == nullptr || target.place_in_report == 0) return std::nullopt;
  PresetOptions options;
  options.written = Written::kNoPictures;
  options.spots = spots;
  auto preset = target.exporter(lights, "fresh", options);
  if (!preset) return std::nullopt;
  const auto named = [&](std::string_view name) {
    return std::ranges::find(preset->files, name, &PresetFile::name);
  };
  const std::string name = "fresh" + std::string(target.ending);
  const auto file = named(name);
  if (file == preset->files.end()) return std::nullopt;
  auto read =
      LightsOfPreset(name, file->contents, [&](const std::string& beside) -> Result<std::string> {
        const auto found = named(beside);
        if (found == preset->files.end()) return Refused("not_found", beside, "is not written");
        return found->contents;
      });
  if (!read) return std::nullopt;
  std::erase_if(preset->warnings, [](const Warning& w) {
    return w.code != "substituted" && w.code != "cone_profile";
  });
  return FreshPreset{*std::move(read), std::move(preset->warnings)};
}

}  // namespace lightcal
