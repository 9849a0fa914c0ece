// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>

namespace lightcal::app {

// --rig and --bare of every command that writes presets. --bare is what is done anyway.
void AddSceneFlags(CLI::App& parser, bool& rig, bool& bare);

}  // namespace lightcal::app
