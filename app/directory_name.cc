// SPDX-License-Identifier: Apache-2.0
#include "directory_name.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace lightcal::app {

CLI::Validator DirectoryName(const std::string& also) {
  static constexpr std::array<std::string_view, 22> kEndings = {
      ".json", ".html", ".exr", ".hdr",  ".png",  ".svg", ".csv", ".gltf", ".glb", ".usda", ".usd",
      ".tscn", ".ies",  ".ldt", ".gdtf", ".pbrt", ".xml", ".py",  ".js",   ".t3d", ".cs",   ".h"};
  return {[also](std::string& text) -> std::string {
            const std::filesystem::path path(text);
            std::error_code error;
            const std::string ending = path.extension().string();
            const bool file = std::ranges::find(kEndings, ending) != kEndings.end();
            if (!file || ending == also || std::filesystem::is_directory(path, error)) return "";
            return "\"" + text +
                   "\" is a file's name, and this is the directory that the files go " +
                   "to: leave the ending out";
          },
          ""};
}

}  // namespace lightcal::app
