// SPDX-License-Identifier: Apache-2.0
// Uncertainty in photographic stops, as people on a set speak of light.
#pragma once

#include <optional>

#include "lightcal/core/uncertain.h"

namespace lightcal {

// Half the width of the interval, 1/2 log2(high/low): +-25 % is +-0.37 stop. Absent where it
// reaches down to 0: an upper limit.
[[nodiscard]] std::optional<double> HalfWidthStops(const Uncertain& u);

// One standard deviation of a natural logarithm as such a half width: kZ95 sd / ln 2.
[[nodiscard]] double StopsOfSd(double sd_of_ln);

}  // namespace lightcal
