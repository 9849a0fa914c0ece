// SPDX-License-Identifier: Apache-2.0
// Student's t, of estimates that rest on few.
#pragma once

#include "lightcal/core/uncertain.h"

namespace lightcal {

// Two-sided 95 % points of Student's t over the normal one's, for degrees of freedom from 1 on
// (need not be whole); within 0.5 % of the table from three on, the table's own at 1 and 2. Source:
// any table of the distribution; Abramowitz & Stegun 26.7.5.
[[nodiscard]] inline double StudentOverNormal(double freedom) {
  if (freedom < 1.5) return 12.706 / kZ95;
  if (freedom < 2.5) return 4.303 / kZ95;
  const double z2 = kZ95 * kZ95;
  const double first = (z2 + 1.0) / 4.0;
  const double second = ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
  const double third = (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
  const double fourth =
      ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0;
  return 1.0 + (first + (second + (third + fourth / freedom) / freedom) / freedom) / freedom;
}

}  // namespace lightcal
