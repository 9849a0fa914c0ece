// SPDX-License-Identifier: Apache-2.0
// A preset file against the readings of the session it came from.
#pragma once

#include <string>
#include <vector>

#include "console.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

struct PresetCheck {
  std::string file, session, max_error = "5%", white;
  std::vector<std::string> states;
};

// Ends with an error beside the whole answer where the file lacks a lamp, has one more or in
// another colour, shares out its light otherwise than an export of the same lamps,
// or strays from what the meter showed of one by more than max_error.
[[nodiscard]] Result<void> CheckPreset(const PresetCheck& options, Console& console);

}  // namespace lightcal::app
