// SPDX-License-Identifier: Apache-2.0
// How sure aims are that were found from shared features.
#pragma once

#include "lightcal/imaging/panorama/aim_bundle.h"

namespace lightcal {

// The covariance of all parameters about the truth, at the solution: by leaving out fields of 6
// degrees, inside which errors are taken to be one (CR3), by the priors, and by what a lens may do
// beside f, a and b: six terms linear and quadratic in the place, as large as the residuals make
// likely.
[[nodiscard]] AimMatrix CovarianceOfAims(const AimBundle& bundle, const AimVector& at);

}  // namespace lightcal
