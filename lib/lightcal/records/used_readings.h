// SPDX-License-Identifier: Apache-2.0
// How many of a light's readings its estimate rests on, for people.
#pragma once

#include <algorithm>
#include <string>

#include "lightcal/records/fitted_light.h"

namespace lightcal {

// "2 of 3": of the readings of illuminance, as one of colour alone has no part in the estimate.
[[nodiscard]] inline std::string UsedOfReadings(const FitDiagnostics& fit) {
  const int of = std::min(fit.readings, fit.used + static_cast<int>(fit.rejected.size()));
  return std::to_string(fit.used) + " of " + std::to_string(std::max(fit.used, of));
}

}  // namespace lightcal
