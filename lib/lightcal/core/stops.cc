// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/stops.h"

#include <cmath>
#include <numbers>

namespace lightcal {

std::optional<double> HalfWidthStops(const Uncertain& u) {
  const double low = u.low.value_or(u.value - u.u95);
  const double high = u.high.value_or(u.value + u.u95);
  if (!(low > 0.0) || !(high >= low)) return std::nullopt;
  return 0.5 * std::log2(high / low);
}

double StopsOfSd(double sd_of_ln) { return kZ95 * sd_of_ln / std::numbers::ln2; }

}  // namespace lightcal
