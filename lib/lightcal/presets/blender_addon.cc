// SPDX-License-Identifier: Apache-2.0
// lightcal-blender-addon.zip: the add-on of scripts/blender_addon, for Blender 3.4 and later
// (bl_info) and as an extension from 4.2 on (blender_manifest.toml). It links light.json files
// itself, so that one archive serves all lights.
#include <array>
#include <string>

#include "lightcal/presets/exporters.h"
#include "lightcal/presets/scripts.h"
#include "lightcal/presets/stored_zip.h"

namespace lightcal {
Result<Preset> ExportBlenderAddon(const LightFile&, const std::string&, const PresetOptions&) {
  // An extension's manifest stands at the archive's root or in its one folder.
  constexpr std::array<const char*, 8> kFiles = {
      "__init__.py", "blender_manifest.toml", "cards.py", "lamps.py", "laws.py",
      "panel.py",    "pictures.py",           "states.py"};
  std::array<PresetFile, kFiles.size()> entries;
  for (std::size_t i = 0; i < kFiles.size(); ++i) {
    const std::string file = kFiles[i];
    entries[i] = {"lightcal/" + file, std::string(Script("blender_addon/" + file))};
  }
  Preset preset;
  preset.files.push_back({"lightcal-blender-addon.zip", StoredZip(entries)});
  preset.paste = "Edit > Preferences > Add-ons > Install: " + std::string(kPasteDirectory) +
                 "/lightcal-blender-addon.zip, then link a light.json in the 3D view's sidebar";
  return preset;
}

}  // namespace lightcal
