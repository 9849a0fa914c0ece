// SPDX-License-Identifier: Apache-2.0
// The report page with the figures to type into engines, as `report` and `run` write it.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

// ReportPage with each light's engine figures (of the lights presets can export).
[[nodiscard]] std::string ReportHtml(const LightFile& lights, std::string_view title);

}  // namespace lightcal::app
