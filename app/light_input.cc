// SPDX-License-Identifier: Apache-2.0
#include "light_input.h"

#include <filesystem>
#include <system_error>

#include "guide/shell_word.h"
#include "input_files.h"
#include "lightcal/records/light_codec.h"
#include "lightcal/records/session_codec.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

// Where the lights of a directory or a session's .toml lie.
Result<std::string> LightFileBelow(const std::string& path) {
  const fs::path directory = fs::path(JournalPath(path)).parent_path();
  for (const fs::path& candidate : {directory / "out" / "light.json", directory / "light.json"}) {
    std::error_code error;
    if (fs::is_regular_file(candidate, error)) return candidate.string();
  }
  return Refused(
      "no_light_file", path,
      "holds no light.json, nor does its out; fit it first: lightcal run " + ShellWord(path));
}

}  // namespace

Result<std::string> LightFileAt(const std::string& path) {
  std::error_code error;
  const bool below = fs::is_directory(path, error) || fs::path(path).extension() == ".toml";
  return below ? LightFileBelow(path) : path;
}

Result<LightFile> LightsIn(const std::string& path) {
  const auto file = LightFileAt(path);
  if (!file) return tl::unexpected(file.error());
  const auto text = ReadInputFile(*file);
  if (!text) return tl::unexpected(text.error());
  return LightFileOrPresetFromJson(*text, *file);
}

}  // namespace lightcal::app
