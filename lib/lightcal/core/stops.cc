// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/stops.h"

#include <cmath>
#include <numbers>

namespace lightcal {

std::optional<double> HalfWidthStops(const Uncertain& u) {
  const double low = LowEnd(u);
  const double high = HighEnd(u);
  if (!(low > 0.0) || !(high >= low)) return std::nullopt;
  return 0.5 * std::log2(high / low);
}

double StopsOfSd(double sd_of_ln) { return kZ95 * sd_of_ln / std::numbers::ln2; }

}  // namespace lightcal
