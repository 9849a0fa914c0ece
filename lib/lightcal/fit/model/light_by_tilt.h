// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace lightcal::fit {

// A lamp's direct light at one meter over that of its stated aim, by the aim's tilts towards C0 and
// C90 (aim_error.h).
using LightByTilt = std::function<double(double x, double y)>;

}  // namespace lightcal::fit
