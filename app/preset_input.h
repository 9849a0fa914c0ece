// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightcal/presets/check/read_preset.h"

namespace lightcal::app {

// Files in the directory of this one, which names them.
[[nodiscard]] FileBeside FilesBeside(const std::string& path);

}  // namespace lightcal::app
