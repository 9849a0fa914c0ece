// SPDX-License-Identifier: Apache-2.0
#include "preset_flags.h"

#include <CLI/CLI.hpp>

namespace lightcal::app {

void AddSceneFlags(CLI::App& parser, bool& rig, bool& bare) {
  parser.add_flag("--rig", rig,
                  "Also STEM.rig.EXT: the lights with cards, camera and exposure, in a scene or "
                  "level of its own");
  parser.add_flag("--bare", bare, "The lights alone, as without it");
}

}  // namespace lightcal::app
