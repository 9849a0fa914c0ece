// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

// What a light is known by in lists of many: name, kind, strength, flux and colour, each with its
// u95, by the keys of light.json.
[[nodiscard]] nlohmann::ordered_json LightSummary(const FittedLight& light);

}  // namespace lightcal::app
