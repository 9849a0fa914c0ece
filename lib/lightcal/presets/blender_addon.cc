// SPDX-License-Identifier: Apache-2.0
// lightcal-blender-addon.zip: the add-on of scripts/blender_addon, for Blender 3.4 and later
// (bl_info) and as an extension from 4.2 on (blender_manifest.toml). It links light.json files
// itself, so that one archive serves all lights. Entries are stored, not packed.
// Source: PKWARE APPNOTE 6.3.10, 4.3.
#include <array>
#include <cstdint>
#include <string>

#include "lightcal/core/crc32.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/scripts.h"

namespace lightcal {
namespace {

std::string LittleEndian(std::uint32_t value, unsigned bytes) {
  std::string out;
  for (unsigned i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8U * i) & 0xFFU);
  return out;
}

// From the version to the extra field's length, in both headers. Dated 1980-01-01.
std::string EntryHead(const std::string& name, std::string_view data) {
  constexpr std::uint32_t kVersion = 20, kUtf8Names = 0x0800, kFirstDay = 0x21;
  const auto size = static_cast<std::uint32_t>(data.size());
  return LittleEndian(kVersion, 2) + LittleEndian(kUtf8Names, 2) + LittleEndian(0, 2) +
         LittleEndian(0, 2) + LittleEndian(kFirstDay, 2) + LittleEndian(Crc32(data), 4) +
         LittleEndian(size, 4) + LittleEndian(size, 4) +
         LittleEndian(static_cast<std::uint32_t>(name.size()), 2) + LittleEndian(0, 2);
}

struct Entry {
  std::string name;
  std::string_view data;
};

template <std::size_t N>
std::string StoredZip(const std::array<Entry, N>& entries) {
  std::string zip, directory;
  for (const Entry& entry : entries) {
    const std::string head = EntryHead(entry.name, entry.data);
    const auto at = static_cast<std::uint32_t>(zip.size());
    zip += "PK\x03\x04" + head + entry.name;
    zip += entry.data;
    directory += "PK\x01\x02" + LittleEndian(20, 2) + head + LittleEndian(0, 2) +
                 LittleEndian(0, 2) + LittleEndian(0, 2) + LittleEndian(0, 4) +
                 LittleEndian(at, 4) + entry.name;
  }
  const auto start = static_cast<std::uint32_t>(zip.size());
  return zip + directory + "PK\x05\x06" + LittleEndian(0, 4) + LittleEndian(N, 2) +
         LittleEndian(N, 2) + LittleEndian(static_cast<std::uint32_t>(directory.size()), 4) +
         LittleEndian(start, 4) + LittleEndian(0, 2);
}

}  // namespace

Result<Preset> ExportBlenderAddon(const LightFile&, const std::string&, const PresetOptions&) {
  // An extension's manifest stands at the archive's root or in its one folder.
  constexpr std::array<const char*, 8> kFiles = {
      "__init__.py", "blender_manifest.toml", "cards.py", "lamps.py", "laws.py",
      "panel.py",    "pictures.py",           "states.py"};
  std::array<Entry, kFiles.size()> entries;
  for (std::size_t i = 0; i < kFiles.size(); ++i) {
    const std::string file = kFiles[i];
    entries[i] = {"lightcal/" + file, Script("blender_addon/" + file)};
  }
  Preset preset;
  preset.files.push_back({"lightcal-blender-addon.zip", StoredZip(entries)});
  preset.paste = "Edit > Preferences > Add-ons > Install: " + std::string(kPasteDirectory) +
                 "/lightcal-blender-addon.zip, then link a light.json in the 3D view's sidebar";
  return preset;
}

}  // namespace lightcal
