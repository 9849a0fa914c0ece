// SPDX-License-Identifier: Apache-2.0
// 3 x 3 matrices, as colour transforms are.
#pragma once

#include <array>
#include <cstddef>

namespace lightcal {

using Matrix3 = std::array<std::array<double, 3>, 3>;  // rows
using Column3 = std::array<double, 3>;

// M v.
[[nodiscard]] constexpr Column3 Times(const Matrix3& m, const Column3& v) {
  Column3 out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

// M^-1 by cofactors.  Holds for a determinant that is not 0; not finite else.
[[nodiscard]] constexpr Matrix3 Inverse(const Matrix3& m) {
  const auto cofactor = [&m](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double determinant =
      m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  Matrix3 out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out[i][j] = cofactor(j, i) / determinant;
  }
  return out;
}

}  // namespace lightcal
