// SPDX-License-Identifier: Apache-2.0
// A dome of light as nine numbers: spherical harmonics to order 2.
#pragma once

#include <array>
#include <cmath>

#include "lightcal/light/models/receiver.h"

namespace lightcal {

// Coefficients L_lm = int L(w) Y_lm(w) dw of the real harmonics, in the order 00, 1-1, 10, 11,
// 2-2, 2-1, 20, 21, 22 of Ramamoorthi & Hanrahan, in the session's axes.          [cd/m^2]
struct DomeHarmonics {
  std::array<double, 9> luminance{};
  double total = 0.0;  // int L dw, all around [lx]: what the error is measured by

  // Adds light of luminance times solid angle `lux` from unit direction `from`.
  void Add(const Vec3& from, double lux) {
    const std::array<double, 9> y = Basis(from);
    for (std::size_t i = 0; i < y.size(); ++i) luminance[i] += lux * y[i];
    total += lux;
  }

  template <class T>
  [[nodiscard]] static std::array<T, 9> Basis(const Vec3Of<T>& w) {
    using S = Scalar<T>;
    const T& x = w[0];
    const T& y = w[1];
    const T& z = w[2];
    constexpr S k1 = S(0.4886025119029199);
    constexpr S k2 = S(1.0925484305920792);
    return {T(S(0.28209479177387814)),
            k1 * y,
            k1 * z,
            k1 * x,
            k2 * x * y,
            k2 * y * z,
            S(0.31539156525252005) * (S(3) * z * z - S(1)),
            k2 * x * z,
            S(0.5462742152960396) * (x * x - y * y)};
  }
};

//   E(n) = pi L00 Y00 + (2 pi/3) sum L1m Y1m(n) + (pi/4) sum L2m Y2m(n)               [lx]
// The kernel max(0, c) becomes 1/4 + c/2 + (5/16)(3c^2 - 1)/2, at most 3/32 off (at c = 0):
//   |error| <= (3/32) int L dw = DomeErrorBound.
// Exact for a uniform dome; a sun in it reads 6.25 % high face on, so suns are taken out first.
// Source: Ramamoorthi & Hanrahan, An efficient representation for irradiance environment maps
// (2001); the bound is exact, the reference physics.md 2.10.
template <class T>
[[nodiscard]] T LuxOfDome(const DomeHarmonics& dome, const Vec3Of<T>& normal) {
  using S = Scalar<T>;
  constexpr S kBand[3] = {S(3.141592653589793), S(2.0943951023931953), S(0.7853981633974483)};
  const std::array<T, 9> y = DomeHarmonics::Basis(normal);
  T sum(0);
  for (std::size_t i = 0; i < y.size(); ++i) {
    sum += kBand[i == 0 ? 0 : (i < 4 ? 1 : 2)] * static_cast<S>(dome.luminance[i]) * y[i];
  }
  return sum;
}
[[nodiscard]] inline double DomeErrorBound(const DomeHarmonics& dome) {
  return 3.0 / 32.0 * dome.total;
}

}  // namespace lightcal
