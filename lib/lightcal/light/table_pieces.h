// SPDX-License-Identifier: Apache-2.0
// One plane of an intensity table: its cubic pieces, and what it sends into a zone of the sphere.
#pragma once

#include <span>

namespace lightcal {

// p(t) = a + b t + c t^2 + d t^3 on t = 0..1.
struct CubicPiece {
  double a = 0.0, b = 0.0, c = 0.0, d = 0.0;
  [[nodiscard]] constexpr double At(double t) const { return a + t * (b + t * (c + t * d)); }
};
// The Hermite cubic between two values with the given slopes per piece.
[[nodiscard]] constexpr CubicPiece PieceFromSlopes(double v0, double v1, double s0, double s1) {
  return {v0, s0, 3.0 * (v1 - v0) - 2.0 * s0 - s1, 2.0 * (v0 - v1) + s0 + s1};
}

// Derivative at each node of the parabola through it and its neighbours, at the ends of the first
// and last parabola; with two nodes the secant. All spans as long as theta, at least two.
void ThreePointSlopes(std::span<const double> theta, std::span<const double> values,
                      std::span<double> slopes);

// int I(theta) sin(theta) dtheta over the nodes' range [cd rad]: of the broken line, closed form;
// of max(0, cubic), by Gauss-Legendre between its zeros, exact to rounding for steps up to pi.
// theta in radians, ascending within 0..pi; intensities not negative.
[[nodiscard]] double SineIntegralOfLinear(std::span<const double> theta,
                                          std::span<const double> values);
[[nodiscard]] double SineIntegralOfCubic(std::span<const double> theta,
                                         std::span<const double> values,
                                         std::span<const double> slopes);

}  // namespace lightcal
