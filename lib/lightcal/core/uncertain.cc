// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/uncertain.h"

#include <cmath>

namespace lightcal {

Uncertain UncertainFromLog(double mean_ln, double sd_ln) {
  const double value = std::exp(mean_ln);
  const double half = kZ95 * sd_ln;
  return {value, value * std::sinh(half), value * std::exp(-half), value * std::exp(half)};
}

Uncertain UncertainFromNormal(double value, double sd) {
  return {value, kZ95 * sd, std::nullopt, std::nullopt};
}

}  // namespace lightcal
