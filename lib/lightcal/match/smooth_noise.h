// SPDX-License-Identifier: Apache-2.0
// Random functions of wavelength without steps.
#pragma once

#include <array>
#include <random>

#include "lightcal/colorimetry/gel_stack.h"

namespace lightcal::match {

// Normal at every node, mean 0, variance 1, correlated by exp(-(dl/length)^2 / 2).
class SmoothNoise {
 public:
  explicit SmoothNoise(double length_nm);
  [[nodiscard]] NodeValues Draw(std::mt19937_64& random) const;

 private:
  std::array<NodeValues, kNodeCount> root_{};  // lower triangle of Cholesky's root
};

}  // namespace lightcal::match
