// SPDX-License-Identifier: Apache-2.0
// Every target lightcal can export to. A new engine is one file in this room and one row here.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lightcal/presets/preset.h"

namespace lightcal {

struct PresetTarget {
  std::string_view name;  // the word it is asked for by
  Exporter exporter;
  std::string_view verified;  // how the output was checked, for people
};

[[nodiscard]] std::span<const PresetTarget> PresetTargets();

// The row of that name. Wrong usage when there is none; the message names the nearest.
[[nodiscard]] Result<PresetTarget> FindPresetTarget(std::string_view name);

}  // namespace lightcal
