// SPDX-License-Identifier: Apache-2.0
// Pictures that an engine rendered of a rig against the meter.
#pragma once

#include <string>
#include <vector>

#include "console.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

struct RenderCheck {
  std::string engine, max_error = "5%";
  std::vector<std::string> renders, rigs;  // a rig for each picture, in their order
};

// Ends with an error beside the whole answer where a card is brighter or darker than the meter says
// by more than max_error and what the picture leaves open, has another colour than its lamps give
// it, or a panorama hangs another way.
[[nodiscard]] Result<void> CheckRender(const RenderCheck& options, Console& console);

}  // namespace lightcal::app
