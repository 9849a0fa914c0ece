// SPDX-License-Identifier: Apache-2.0
// What an option takes that names the directory of a command's outputs.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace lightcal::app {

// Not a name that ends as one of our files does: "lamp.gltf" would become a directory. Unless one
// of that name is there, or it ends in `also`.
[[nodiscard]] CLI::Validator DirectoryName(const std::string& also = "");

}  // namespace lightcal::app
