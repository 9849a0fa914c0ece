// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/table_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/photometry/angular_table.h"

namespace lightcal {
namespace {

// Positive half of the 12-point Gauss-Legendre rule: zeros of P12 and their weights.
struct GaussNode {
  double x, weight;
};
constexpr std::array<GaussNode, 6> kGauss = {{{0.1252334085114690, 0.2491470458134028},
                                              {0.3678314989981802, 0.2334925365383548},
                                              {0.5873179542866175, 0.2031674267230659},
                                              {0.7699026741943047, 0.1600783285433462},
                                              {0.9041172563704748, 0.1069393259953184},
                                              {0.9815606342467193, 0.0471753363865118}}};

// Slope at x[1] of the parabola through three points.
double MiddleSlope(const double* x, const double* v) {
  const double h0 = x[1] - x[0];
  const double h1 = x[2] - x[1];
  return ((v[1] - v[0]) / h0 * h1 + (v[2] - v[1]) / h1 * h0) / (h0 + h1);
}
double EndSlope(double secant, double next_slope) { return 2.0 * secant - next_slope; }

// Where max(0, cubic) may bend within 0..1, ascending, with the ends.
struct Cuts {
  std::array<double, 6> at{};
  int count = 0;
  void Add(double t) { at[static_cast<std::size_t>(count++)] = t; }
};

Cuts TurningPoints(const CubicPiece& p) {
  Cuts cuts;
  cuts.Add(0.0);
  // p' = b + 2 c t + 3 d t^2, solved without cancellation.
  const double discriminant = p.c * p.c - 3.0 * p.d * p.b;
  if (discriminant > 0.0) {
    const double q = -(p.c + std::copysign(std::sqrt(discriminant), p.c));
    double t0 = q != 0.0 ? p.b / q : -1.0;
    double t1 = p.d != 0.0 ? q / (3.0 * p.d) : -1.0;
    if (t1 < t0) std::swap(t0, t1);
    if (t0 > 0.0 && t0 < 1.0) cuts.Add(t0);
    if (t1 > 0.0 && t1 < 1.0 && t1 != t0) cuts.Add(t1);
  }
  cuts.Add(1.0);
  return cuts;
}

double ZeroBetween(const CubicPiece& p, double low, double high) {
  const bool rising = p.At(high) > 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((p.At(middle) > 0.0) == rising ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

Cuts PositiveCuts(const CubicPiece& p) {
  const Cuts turns = TurningPoints(p);
  Cuts cuts;
  cuts.Add(0.0);
  for (int i = 1; i < turns.count; ++i) {
    const double low = turns.at[static_cast<std::size_t>(i - 1)];
    const double high = turns.at[static_cast<std::size_t>(i)];
    if (p.At(low) * p.At(high) < 0.0) cuts.Add(ZeroBetween(p, low, high));
  }
  cuts.Add(1.0);
  return cuts;
}

double IntegralOfPiece(const CubicPiece& p, double theta, double step) {
  const Cuts cuts = PositiveCuts(p);
  double sum = 0.0;
  for (int i = 1; i < cuts.count; ++i) {
    const double low = cuts.at[static_cast<std::size_t>(i - 1)];
    const double half = 0.5 * (cuts.at[static_cast<std::size_t>(i)] - low);
    const double middle = low + half;
    if (!(p.At(middle) > 0.0)) continue;
    for (const GaussNode& node : kGauss) {
      for (const double t : {middle - half * node.x, middle + half * node.x}) {
        sum += half * step * node.weight * p.At(t) * std::sin(theta + t * step);
      }
    }
  }
  return sum;
}

}  // namespace

void ThreePointSlopes(std::span<const double> theta, std::span<const double> values,
                      std::span<double> slopes) {
  const std::size_t last = theta.size() - 1;
  const auto secant = [&](std::size_t i) {
    return (values[i + 1] - values[i]) / (theta[i + 1] - theta[i]);
  };
  for (std::size_t i = 1; i < last; ++i) slopes[i] = MiddleSlope(&theta[i - 1], &values[i - 1]);
  slopes[0] = last == 1 ? secant(0) : EndSlope(secant(0), slopes[1]);
  slopes[last] = last == 1 ? secant(0) : EndSlope(secant(last - 1), slopes[last - 1]);
}

double SineIntegralOfLinear(std::span<const double> theta, std::span<const double> values) {
  std::vector<Radians> angles;
  std::vector<Candela> intensities;
  for (const double t : theta) angles.emplace_back(t);
  for (const double v : values) intensities.emplace_back(v);
  const auto flux = FluxOfAngularTable(angles, intensities);
  return flux ? flux->value() / (2.0 * std::numbers::pi) : 0.0;
}

double SineIntegralOfCubic(std::span<const double> theta, std::span<const double> values,
                           std::span<const double> slopes) {
  double sum = 0.0;
  for (std::size_t i = 1; i < theta.size(); ++i) {
    const double step = theta[i] - theta[i - 1];
    sum += IntegralOfPiece(
        PieceFromSlopes(values[i - 1], values[i], slopes[i - 1] * step, slopes[i] * step),
        theta[i - 1], step);
  }
  return sum;
}

}  // namespace lightcal
