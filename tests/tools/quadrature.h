// SPDX-License-Identifier: Apache-2.0
// The independent law of these tests: integrals by brute force. Includes nothing of lightcal.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

namespace lightcal::test {

// Composite midpoint rule, error O(n^-2).
template <class Function>
double Integrate(Function f, double from, double to, std::size_t n = 20000) {
  const double step = (to - from) / static_cast<double>(n);
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) sum += f(from + (static_cast<double>(i) + 0.5) * step);
  return sum * step;
}

// 2 pi int f(theta) sin(theta) dtheta: the flux of an axially symmetric intensity f.
template <class Function>
double IntegrateOverSphere(Function f, std::size_t n = 20000) {
  return 2.0 * std::numbers::pi *
         Integrate([&f](double theta) { return f(theta) * std::sin(theta); }, 0.0, std::numbers::pi,
                   n);
}

}  // namespace lightcal::test
