// SPDX-License-Identifier: Apache-2.0
#include "preset_input.h"

#include <filesystem>

#include "input_files.h"
#include "output_files.h"

namespace lightcal::app {

FileBeside FilesBeside(const std::string& path) {
  return [folder = std::filesystem::path(path).parent_path()](const std::string& name) {
    return ReadInputFile((folder / name).string());
  };
}

}  // namespace lightcal::app
