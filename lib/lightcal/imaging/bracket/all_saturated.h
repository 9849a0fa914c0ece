// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightcal/core/result.h"

namespace lightcal {

// What a bracket is refused for that shows nothing below the top of its scale. `frame`: its
// shortest.
[[nodiscard]] inline tl::unexpected<Error> AllSaturated(const std::string& frame) {
  return Refused("all_saturated", frame,
                 "every frame is saturated; expose shorter, stop down or use an ND filter");
}

}  // namespace lightcal
