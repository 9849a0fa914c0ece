// SPDX-License-Identifier: Apache-2.0
// Draws from the normal distribution of mean 0 and standard deviation 1, the same digits from the
// same seed with every standard library: std::mt19937_64 is defined to the bit,
// std::normal_distribution is not.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

namespace lightcal {

// The polar method (G. Marsaglia and T. A. Bray, SIAM Review 6, 260 (1964)): a point of the unit
// disk gives two independent draws, of which the second is kept for the next call.
class StandardNormal {
 public:
  [[nodiscard]] double operator()(std::mt19937_64& random) {
    if (kept_) return *std::exchange(kept_, std::nullopt);
    double x = 0.0;
    double y = 0.0;
    double squared = 0.0;
    do {
      x = 2.0 * BelowOne(random) - 1.0;
      y = 2.0 * BelowOne(random) - 1.0;
      squared = x * x + y * y;
    } while (squared > 1.0 || squared == 0.0);
    const double stretch = std::sqrt(-2.0 * std::log(squared) / squared);
    kept_ = x * stretch;
    return y * stretch;
  }

 private:
  // Uniform in [0, 1): numbers next to 2^64 round up to it as doubles.
  static double BelowOne(std::mt19937_64& random) {
    return std::min(static_cast<double>(random()) * 0x1p-64, 1.0 - 0x1p-53);
  }

  std::optional<double> kept_;
};

}  // namespace lightcal
