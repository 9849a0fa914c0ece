// SPDX-License-Identifier: Apache-2.0
// <stem>-<light>.ies and .ldt: each lamp's distribution in absolute candela, for engines and
// lighting calculation. Neither format holds an uncertainty or a colour; <stem>.preset.json does.
#include <algorithm>
#include <set>
#include <utility>

#include "lightcal/core/file_name.h"
#include "lightcal/core/interval_text.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/light_distribution.h"
#include "lightcal/presets/photometric_files.h"
#include "lightcal/records/photometric_codec.h"
#include "lightcal/records/stated_beam.h"

namespace lightcal {
namespace {

// A name as part of a file name that no shell or file system minds.
std::string PeakText(const FittedLight& lamp) {
  if (!lamp.intensity_cd || !(lamp.intensity_cd->value > 0.0)) return {};
  return "intensity " + PlainInterval(*lamp.intensity_cd, "cd") +
         (OfStatedBeam(lamp) ? ", " + DistributionWords(lamp) : "");
}

PhotometricFile FileOf(const FittedLight& lamp, IntensityTable table,
                       const Provenance& provenance) {
  PhotometricHeader header;
  header.manufacturer = "lightcal";
  header.luminaire = lamp.name;
  header.report = PeakText(lamp);
  header.laboratory = provenance.generator;
  header.date = provenance.time.substr(0, 10);
  header.lamps.resize(1);
  header.lamps.front().type = std::string(LightKindName(lamp.kind));
  return {std::move(header), std::move(table)};
}

// What each format makes of a file.
using Writer = Result<std::string> (*)(const PhotometricFile& file);

// One a light, in order; absent where it has no intensity by direction.
using FilesOfLights = Result<std::vector<std::optional<PresetFile>>>;

FilesOfLights Files(const LightFile& lights, const std::string& stem, std::string_view extension,
                    Writer write, const TextAsked& asked) {
  std::vector<std::optional<PresetFile>> files;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    const FittedLight& lamp = lights.lights[i];
    auto table = DistributionOf(lamp);
    if (!table) return Propagate(std::move(table));
    files.emplace_back();
    if (!*table) continue;
    const std::string name = DistinctFileName(stem + "-" + FileNamePart(lamp.name), taken);
    files.back() = PresetFile{name + "." + std::string(extension), ""};
    if (!asked(i)) continue;
    auto text = write(FileOf(lamp, **std::move(table), lights.provenance));
    if (!text) return Propagate(std::move(text));
    files.back()->contents = std::move(*text);
  }
  return files;
}

Result<Preset> Export(const LightFile& lights, FilesOfLights files, std::string_view extension) {
  if (!files) return Propagate(std::move(files));
  Preset preset;
  for (std::size_t i = 0; i < files->size(); ++i) {
    if ((*files)[i]) {
      preset.files.push_back(*std::move((*files)[i]));
      continue;
    }
    const FittedLight& lamp = lights.lights[i];
    preset.warnings.push_back({"no_distribution", lamp.name,
                               "a " + std::string(LightKindName(lamp.kind)) +
                                   " light has no intensity by direction: no ." +
                                   std::string(extension) + " is written for it"});
  }
  return preset;
}

}  // namespace

FilesOfLights IesFiles(const LightFile& lights, const std::string& stem, const TextAsked& asked) {
  return Files(
      lights, stem, "ies",
      [](const PhotometricFile& file) { return Result<std::string>(IesText(file)); }, asked);
}

Result<Preset> ExportIes(const LightFile& lights, const std::string& stem,
                         const PresetOptions& options) {
  return Export(lights, IesFiles(lights, stem, EveryText(options.written)), "ies");
}

Result<Preset> ExportLdt(const LightFile& lights, const std::string& stem,
                         const PresetOptions& options) {
  return Export(lights, Files(lights, stem, "ldt", &EulumdatText, EveryText(options.written)),
                "ldt");
}

}  // namespace lightcal
