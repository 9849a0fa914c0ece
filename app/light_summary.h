// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "console.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

// What a light is known by in lists of many: name, kind, strength, flux and colour, each with its
// u95, by the keys of light.json.
[[nodiscard]] Node LightSummary(const FittedLight& light);

// {"value","u95"}
[[nodiscard]] Node ValueAndU95(const Uncertain& u);

}  // namespace lightcal::app
