// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/read_preset.h"

#include <exception>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/preset_table.h"

namespace lightcal {
namespace {

// Only files of the preset's own directory.
FileText OwnDirectory(const FileBeside& beside) {
  return [&beside](const std::string& name) {
    const std::filesystem::path file(name);
    if (file.filename() != file.lexically_normal()) {
      throw std::runtime_error(name + " does not stand beside it");
    }
    auto text = beside(name);
    if (!text) throw std::runtime_error(name + " " + text.error().message);
    return *std::move(text);
  };
}

// A reader's own words: "[json.exception.out_of_range.403] key 'nodes' not found" from there on.
std::string WithoutOrigin(std::string_view message) {
  const std::size_t end = message.find("] ");
  if (message.starts_with("[json.exception.") && end != std::string_view::npos) {
    message.remove_prefix(end + 2);
  }
  return std::string(message);
}

}  // namespace

Result<std::vector<EngineLight>> LightsIfAny(const std::string& path, const std::string& text,
                                             const FileBeside& beside) {
  const PresetTarget* target = TargetOfFile(path);
  if (target == nullptr) return WrongUsage(path, "is none of " + ReadableEndings());
  try {
    auto lights = target->reader(text, OwnDirectory(beside));
    RequireFinite(lights);
    return lights;
  } catch (const std::exception& error) {
    return Refused("bad_preset", path,
                   "is not as lightcal writes it: " + WithoutOrigin(error.what()));
  }
}

Result<std::vector<EngineLight>> LightsOfPreset(const std::string& path, const std::string& text,
                                                const FileBeside& beside) {
  auto lights = LightsIfAny(path, text, beside);
  if (lights && lights->empty()) return Refused("bad_preset", path, "holds no light");
  return lights;
}

}  // namespace lightcal
