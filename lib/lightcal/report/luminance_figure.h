// SPDX-License-Identifier: Apache-2.0
// A picture that a light was measured in, as luminance in false colours with its scale.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/report/report_extras.h"

namespace lightcal::report {

// The picture upright as it was taken, a frame around what was measured, and the scale in cd/m^2.
// Empty without samples. id must be unique in the page.
[[nodiscard]] std::string LuminanceFigure(const LuminancePicture& picture, std::string_view id);

}  // namespace lightcal::report
