// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/normal_mixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lightcal {
namespace {

double Normal(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

}  // namespace

// By Newton's steps on the distribution function within what is known to hold the root, halved
// where one would leave it. What a step of Newton's leaves is about its square.
double QuantileOf(std::span<const NormalPart> mixture, double probability) {
  constexpr double kReach = 9.0;  // standard deviations
  constexpr int kMostSteps = 80;
  constexpr double kDone = 1e-15, kDoneByNewton = 1e-10;  // of the reach
  const double per_sd = 1.0 / std::sqrt(2.0 * std::numbers::pi);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  double whole = 0.0;
  double mean = 0.0;
  for (const NormalPart& part : mixture) {
    low = std::min(low, part.mean - kReach * part.sd);
    high = std::max(high, part.mean + kReach * part.sd);
    whole += part.weight;
    mean += part.weight * part.mean;
  }
  const double reach = high - low;
  double at = std::clamp(mean / whole, low, high);
  for (int i = 0; i < kMostSteps && low < high; ++i) {
    double below = 0.0;
    double density = 0.0;
    for (const NormalPart& part : mixture) {
      if (!(part.sd > 0.0)) {
        below += at >= part.mean ? part.weight : 0.0;
        continue;
      }
      const double z = (at - part.mean) / part.sd;
      below += part.weight * Normal(z);
      density += part.weight * per_sd * std::exp(-0.5 * z * z) / part.sd;
    }
    const double missing = probability * whole - below;
    if (missing == 0.0) break;
    (missing > 0.0 ? low : high) = at;
    double next = density > 0.0 ? at + missing / density : high;
    const bool by_newton = next > low && next < high;
    if (!by_newton) next = 0.5 * (low + high);
    const double step = std::abs(next - at);
    at = next;
    if (step <= (by_newton ? kDoneByNewton : kDone) * reach) break;
  }
  return at;
}

Uncertain UncertainFromLogMixture(std::span<const NormalPart> of_ln) {
  constexpr double kTail = 0.025;
  const auto at = [&](double probability) { return std::exp(QuantileOf(of_ln, probability)); };
  const double low = at(kTail);
  const double high = at(1.0 - kTail);
  return {at(0.5), 0.5 * (high - low), low, high};
}

}  // namespace lightcal
