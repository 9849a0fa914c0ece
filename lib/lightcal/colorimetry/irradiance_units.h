// SPDX-License-Identifier: Apache-2.0
// The units that files give a spectral irradiance in.
#pragma once

#include <string_view>

namespace lightcal {

// The one whose size is nearest, in the logarithm, to W_m2_nm; "" where none lies within
// `tolerance` (relative) of it.
[[nodiscard]] std::string_view IrradianceUnitOf(double W_m2_nm, double tolerance);

}  // namespace lightcal
