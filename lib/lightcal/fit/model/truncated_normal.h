// SPDX-License-Identifier: Apache-2.0
// What is left of a normal variable that cannot be negative, or lies between two bounds.
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

// Moments of a normal (mean, sd) truncated to low <= x <= high. One that has next to nothing there
// (1e-9) is anywhere between them.
[[nodiscard]] inline TruncatedNormal TruncateBetween(double mean, double sd, double low,
                                                     double high) {
  const double a = (low - mean) / sd;
  const double b = (high - mean) / sd;
  const double inside =
      0.5 * (std::erfc(-b / std::numbers::sqrt2) - std::erfc(-a / std::numbers::sqrt2));
  if (!(inside > 1e-9)) return {0.5 * (low + high), (high - low) * (high - low) / 12.0};
  const auto density = [](double z) {
    return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
  };
  const double shift = (density(a) - density(b)) / inside;
  const double narrower = (a * density(a) - b * density(b)) / inside;
  return {mean + sd * shift, sd * sd * (1.0 + narrower - shift * shift)};
}

}  // namespace lightcal::fit
