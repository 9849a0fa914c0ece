// SPDX-License-Identifier: Apache-2.0
// A few equations at once, without a loop of unknown length: Newton's steps solve them by the
// hundred thousand.
// Internal to this room.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace lightcal::fit {

// A symmetric matrix of up to N rows by its lower triangle, row i from i N on.
template <int N>
using SmallMatrix = std::array<double, std::size_t{N} * N>;

// Solves m x = b over the first n rows by Cholesky's m = L L^T, in place: x comes as b. False where
// m is not positive.
template <int N>
[[nodiscard]] bool SolvePositive(SmallMatrix<N>& m, int n, std::array<double, N>& x) {
  for (int i = 0; i < n; ++i) {
    double* const row = m.data() + static_cast<std::ptrdiff_t>(i) * N;
    double square = row[i];
    for (int j = 0; j < i; ++j) {
      const double* const upper = m.data() + static_cast<std::ptrdiff_t>(j) * N;
      double sum = row[j];
      for (int k = 0; k < j; ++k) sum -= row[k] * upper[k];
      row[j] = sum * upper[j];  // whose diagonal is 1/L_jj by now
      square -= row[j] * row[j];
    }
    if (!(square > 0.0)) return false;
    row[i] = 1.0 / std::sqrt(square);
    for (int k = 0; k < i; ++k) x[i] -= row[k] * x[k];
    x[i] *= row[i];
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) x[i] -= m[static_cast<std::size_t>(k * N + i)] * x[k];
    x[i] *= m[static_cast<std::size_t>(i * N + i)];
  }
  return true;
}

}  // namespace lightcal::fit
