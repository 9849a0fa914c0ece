// SPDX-License-Identifier: Apache-2.0
#include "preset_input.h"

#include <filesystem>

#include "output_files.h"

namespace lightcal::app {

FileBeside FilesBeside(const std::string& path) {
  return [folder = std::filesystem::path(path).parent_path()](const std::string& name) {
    return ReadWholeFile((folder / name).string());
  };
}

}  // namespace lightcal::app
