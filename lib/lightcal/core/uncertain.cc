// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/uncertain.h"

#include <cmath>

namespace lightcal {

Uncertain UncertainFromLog(double mean_ln, double sd_ln) {
  const double value = std::exp(mean_ln);
  const double half = kZ95 * sd_ln;
  return {value, value * std::sinh(half), value * std::exp(-half), value * std::exp(half)};
}

void WidenInLn(Uncertain& value, double factor, double relative_sd) {
  if (!(value.value > 0.0) || !value.low || !value.high || !(*value.low > 0.0)) return;
  const auto apart = [&](double end) {
    return std::hypot(factor * std::log(end / value.value), kZ95 * relative_sd);
  };
  value.low = value.value * std::exp(-apart(*value.low));
  value.high = value.value * std::exp(apart(*value.high));
  value.u95 = 0.5 * (*value.high - *value.low);
}

Uncertain UncertainFromNormal(double value, double sd) {
  return {value, kZ95 * sd, std::nullopt, std::nullopt};
}

}  // namespace lightcal
