// SPDX-License-Identifier: Apache-2.0
// Where the solver starts: closed forms and a profile scan, so that it never ends in the mirror
// minimum behind the lamp.
#pragma once

#include "lightcal/fit/model/solve.h"

namespace lightcal::fit {

// Weighted least squares of 1/sqrt(E) = (d + d0)/sqrt(I), which is linear in (1/sqrt I, d0/sqrt I),
// with the prior of d0; E0 is held at `ambient`. With d0 not free: the weighted mean of ln(E d^2).
// Holds for at least one row with measured > ambient; rows in other forms are passed over.
[[nodiscard]] Theta ClosedFormStart(const Estimation& estimation, double ambient);

// The best of 65 values of d0 across its box, (I, E0) at each by non-negative weighted linear least
// squares of the readings themselves (residuals relative to each reading): the exact profile of the
// linear problem.
[[nodiscard]] Theta ScanStart(const Estimation& estimation);

// The one of the two that is right: the scan where E0 is free.
[[nodiscard]] Theta StartOf(const Estimation& estimation);

// The best of 65 values of d0 and a ladder of E0, with ln I the weighted median of each: least sum
// of absolute whitened residuals. Of many rows 24 are scanned.
[[nodiscard]] Theta MedianStart(const Estimation& estimation);

inline constexpr int kScanPoints = 65;

}  // namespace lightcal::fit
