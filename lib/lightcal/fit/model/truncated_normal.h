// SPDX-License-Identifier: Apache-2.0
// What is left of a normal variable that cannot be negative.
#pragma once

#include <cmath>
#include <numbers>

namespace lightcal::fit {

struct TruncatedNormal {
  double mean = 0.0;
  double variance = 0.0;
};

// Moments of a normal (mean, sd) truncated to x >= 0.
[[nodiscard]] inline TruncatedNormal TruncateAtZero(double mean, double sd) {
  const double alpha = -mean / sd;
  if (alpha > 8.0) {  // far below the bound: an exponential tail of length sd/alpha
    const double length = sd / alpha;
    return {length, length * length};
  }
  const double density = std::exp(-0.5 * alpha * alpha) / std::sqrt(2.0 * std::numbers::pi);
  const double tail = 0.5 * std::erfc(alpha / std::numbers::sqrt2);
  const double lambda = density / tail;
  return {mean + sd * lambda, sd * sd * (1.0 + alpha * lambda - lambda * lambda)};
}

}  // namespace lightcal::fit
