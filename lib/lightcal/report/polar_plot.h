// SPDX-License-Identifier: Apache-2.0
// The polar diagram of a measured distribution.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/light/intensity_table.h"

namespace lightcal::report {

// A whole SVG file with its style sheet: candela against gamma, nadir downwards, C0 to the right
// and C180 to the left as a full line, C90 and C270 as a dashed one, with rings of equal intensity.
// Only the lower half where the lamp has no light above the horizon. `title` is any UTF-8 text.
[[nodiscard]] std::string PolarPlot(const IntensityTable& table, std::string_view title);

}  // namespace lightcal::report
