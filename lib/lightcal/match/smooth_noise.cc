// SPDX-License-Identifier: Apache-2.0
#include "lightcal/match/smooth_noise.h"

#include <algorithm>
#include <cmath>

#include "lightcal/core/standard_normal.h"

namespace lightcal::match {

SmoothNoise::SmoothNoise(double length_nm) {
  constexpr double kJitter = 1e-8;  // the root of so smooth a covariance is not numerically whole
  for (std::size_t i = 0; i < kNodeCount; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double apart = (NodeNm(i) - NodeNm(j)) / length_nm;
      double rest = std::exp(-0.5 * apart * apart) + (i == j ? kJitter : 0.0);
      for (std::size_t k = 0; k < j; ++k) rest -= root_[i][k] * root_[j][k];
      root_[i][j] = i == j ? std::sqrt(std::max(rest, kJitter)) : rest / root_[j][j];
    }
  }
}

NodeValues SmoothNoise::Draw(std::mt19937_64& random) const {
  StandardNormal normal;
  NodeValues independent{};
  for (double& each : independent) each = normal(random);
  NodeValues out{};
  for (std::size_t i = 0; i < kNodeCount; ++i) {
    for (std::size_t j = 0; j <= i; ++j) out[i] += root_[i][j] * independent[j];
  }
  return out;
}

}  // namespace lightcal::match
