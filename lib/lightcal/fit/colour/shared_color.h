// SPDX-License-Identifier: Apache-2.0
// One lamp's colour from several readings, instruments and lights beside its own. Internal to
// fit/colour.
#pragma once

#include <vector>

#include "lightcal/fit/colour/color_readings.h"

namespace lightcal::fit {

// With y the chromaticity of a reading i by the instrument g, c the lamp's:
//   y = c + w_i (1 + k_i) T + a_i A + e_g + e_i
// w, a the shares of the walls' light and of ambient light (weighed by X + Y + Z), T what walls do
// to the lamp's colour (light/wall_tint.h), A what ambient light differs by (1 sigma .07 in x, .03
// in y: of anything white), k what all shares have in common, e_g the instrument's own error, e_i
// how readings scatter and tints differ from place to place. Generalised least squares, everything
// but c under its prior.
struct SharedColor {
  Estimate2 color;
  bool in_mired = false;                // (mired, Duv), else (x, y)
  Matrix2 by_others = Matrix2::Zero();  // of its covariance, what walls and ambient light bring
  bool scatters = false;                // a reading lies beyond 3 sigma of its instrument
  bool disagrees = false;  // instruments and places do; the covariance is widened by that (Birge)
};

// In (mired, Duv) if each reading has them and no other light is in any; else in (x, y).
[[nodiscard]] SharedColor SolveSharedColor(const std::vector<ColorReading>& readings,
                                           CctMethod method);

}  // namespace lightcal::fit
