// SPDX-License-Identifier: Apache-2.0
// The last digits of a least-squares optimum: solvers stop when the cost no longer falls, which
// leaves half of the digits of the parameters.
// Internal to this room.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "lightcal/fit/model/least_squares_problem.h"

namespace lightcal::fit {

// What the priors of free parameters add to J^T r and, where asked, to J^T J.
template <class P>
void AddPriors(const P& problem, const ValuesOf<P>& theta, VectorOf<P>& gradient,
               SquareOf<P>* normal) {
  for (int k = 0; k < P::kCount; ++k) {
    if (!HasPrior(problem, k)) continue;
    const ParameterRule& rule = problem.rules[k];
    const double weight = 1.0 / (rule.prior_sd * rule.prior_sd);
    if (normal != nullptr) (*normal)(k, k) += weight;
    gradient[k] += weight * (theta[k] - rule.prior_mean);
  }
}

// J^T r of rows and priors over all parameters; J^T J is added to `normal` where asked.
template <class P>
[[nodiscard]] VectorOf<P> GradientAt(const P& problem, const ValuesOf<P>& theta,
                                     SquareOf<P>* normal = nullptr) {
  VectorOf<P> gradient = VectorOf<P>::Zero();
  VectorOf<P> j;
  for (std::size_t i = 0; i < problem.RowCount(); ++i) {
    const double residual = DifferentiateAt(problem, i, theta.data(), j.data());
    for (int k = 0; normal != nullptr && k < P::kCount; ++k) {
      if (j[k] != 0.0) normal->col(k) += j * j[k];  // of many parameters a row knows few
    }
    gradient += j * residual;
  }
  AddPriors(problem, theta, gradient, normal);
  return gradient;
}

// Both.
template <class P>
struct NormalEquations {
  SquareOf<P> normal = SquareOf<P>::Zero();
  VectorOf<P> gradient = VectorOf<P>::Zero();
};

template <class P>
[[nodiscard]] NormalEquations<P> NormalEquationsAt(const P& problem, const ValuesOf<P>& theta) {
  NormalEquations<P> out;
  out.gradient = GradientAt(problem, theta, &out.normal);
  return out;
}

// The cost and its first and second derivatives: `bend` adds to J^T J how the rows bend. Cost and
// gradient are infinite where a row has no value.
template <class P>
struct SecondOrder : NormalEquations<P> {
  double cost = 0.0;
  SquareOf<P> bend = SquareOf<P>::Zero();
};

template <TellsBend P>
[[nodiscard]] SecondOrder<P> SecondOrderAt(const P& problem, const ValuesOf<P>& theta) {
  SecondOrder<P> out;
  VectorOf<P> j;
  SquareOf<P> second;
  AddPriors(problem, theta, out.gradient, &out.normal);
  out.bend = out.normal;
  for (std::size_t i = 0; i < problem.RowCount(); ++i) {
    double residual = 0.0;
    if (!problem.Bend(i, theta.data(), &residual, j.data(), second.data())) {
      out.cost = std::numeric_limits<double>::infinity();
      out.gradient.setConstant(out.cost);
      return out;
    }
    out.cost += 0.5 * residual * residual;
    for (int a = 0; a < P::kCount; ++a) {
      out.gradient[a] += j[a] * residual;
      for (int b = a; b < P::kCount; ++b) {
        const double square = j[a] * j[b];
        out.normal(b, a) += square;
        out.bend(b, a) += square + residual * second(b, a);
      }
    }
  }
  out.cost += 0.5 * PriorChiSquaredOf(problem, theta);
  for (int a = 0; a < P::kCount; ++a) {
    for (int b = a + 1; b < P::kCount; ++b) {
      out.normal(a, b) = out.normal(b, a);
      out.bend(a, b) = out.bend(b, a);
    }
  }
  return out;
}

// What Newton's steps start from: the second derivatives where they come with the first.
template <class P>
[[nodiscard]] auto NewtonEquationsAt(const P& problem, const ValuesOf<P>& theta) {
  if constexpr (TellsBend<P>) {
    return SecondOrderAt(problem, theta);
  } else {
    return NormalEquationsAt(problem, theta);
  }
}

// The same derivative of the exact gradient by central differences, of what may move.
template <class P>
[[nodiscard]] SquareOf<P> BendByDifferences(const P& problem, const ValuesOf<P>& theta,
                                            const NormalEquations<P>& at) {
  constexpr double kPartOfDeviation = 1e-4;
  SquareOf<P> bend = SquareOf<P>::Zero();
  for (int k = 0; k < P::kCount; ++k) {
    if (!problem.rules[k].free || AtBound(problem, theta, k)) continue;
    const double h = kPartOfDeviation / std::sqrt(at.normal(k, k));
    ValuesOf<P> more = theta, less = theta;
    more[k] += h;
    less[k] -= h;
    bend.col(k) = (GradientAt(problem, more) - GradientAt(problem, less)) / (more[k] - less[k]);
  }
  return 0.5 * (bend + bend.transpose());
}

// Rows and columns of a held parameter become those of the unit matrix.
template <class Matrix>
void Hold(Matrix& normal, int k) {
  normal.row(k).setZero();
  normal.col(k).setZero();
  normal(k, k) = 1.0;
}

// One Gauss-Newton step over the free parameters that are not at a bound. Ceres stops when the cost
// no longer falls, which leaves half of the digits of the parameters; a parameter held at its bound
// slows it further, because the step of the others is not the one along the bound.
template <class P>
[[nodiscard]] ValuesOf<P> GaussNewtonStep(const P& problem, ValuesOf<P> theta) {
  NormalEquations<P> at = NormalEquationsAt(problem, theta);
  for (int k = 0; k < P::kCount; ++k) {
    if (problem.rules[k].free && !AtBound(problem, theta, k)) continue;
    Hold(at.normal, k);
    at.gradient[k] = 0.0;
  }
  // A parameter that no row and no prior knows here has no step.
  if (!(at.normal.diagonal().minCoeff() > 0.0)) return theta;
  const VectorOf<P> scale = at.normal.diagonal().cwiseSqrt().cwiseInverse();
  const SquareOf<P> scaled = scale.asDiagonal() * at.normal * scale.asDiagonal();
  const VectorOf<P> step =
      -(scale.asDiagonal() * scaled.ldlt().solve(scale.asDiagonal() * at.gradient));
  for (int k = 0; k < P::kCount; ++k) theta[k] += step[k];
  return theta;
}

// What is left of the gradient over the free parameters that are not at a bound, each over the root
// of its own curvature: 1 = a standard deviation, were it alone.
template <class P>
[[nodiscard]] double GradientLeft(const P& problem, const ValuesOf<P>& theta,
                                  const NormalEquations<P>& at) {
  double most = 0.0;
  for (int k = 0; k < P::kCount; ++k) {
    if (!problem.rules[k].free || AtBound(problem, theta, k) || !(at.normal(k, k) > 0.0)) continue;
    most = std::max(most, std::abs(at.gradient[k]) / std::sqrt(at.normal(k, k)));
  }
  return most;
}

// One step of Newton's method over the same parameters; `at` are the equations at theta. Gauss and
// Newton's leaves out how rows bend: where offset and walls trade nearly evenly it goes on by parts
// of the way for ever. Unmoved where that is no minimum.
template <class P, class Equations>
[[nodiscard]] ValuesOf<P> NewtonStep(const P& problem, ValuesOf<P> theta, Equations at) {
  const auto moves = [&](int k) { return problem.rules[k].free && !AtBound(problem, theta, k); };
  for (int k = 0; k < P::kCount; ++k) {
    if (moves(k) && !(at.normal(k, k) > 0.0)) return theta;  // no row and no prior knows it
  }
  SquareOf<P> bend;
  if constexpr (TellsBend<P>) {
    bend = at.bend;
  } else {
    bend = BendByDifferences(problem, theta, at);
  }
  for (int k = 0; k < P::kCount; ++k) {
    if (moves(k)) continue;
    Hold(bend, k);
    at.gradient[k] = 0.0;
  }
  if (!bend.allFinite() || !(bend.diagonal().minCoeff() > 0.0)) return theta;
  const VectorOf<P> scale = bend.diagonal().cwiseSqrt().cwiseInverse();
  const SquareOf<P> scaled = scale.asDiagonal() * bend * scale.asDiagonal();
  const auto factors = scaled.ldlt();
  if (!factors.isPositive()) return theta;
  const VectorOf<P> step = -(scale.asDiagonal() * factors.solve(scale.asDiagonal() * at.gradient));
  for (int k = 0; k < P::kCount; ++k) theta[k] += step[k];
  return theta;
}

// The largest change of a parameter, absent where it is no polish: a free one leaves its bounds, or
// a step that is not small.
template <class P>
[[nodiscard]] std::optional<double> SmallStep(const P& problem, const ValuesOf<P>& from,
                                              const ValuesOf<P>& to) {
  constexpr double kLargestStep = 0.05;
  double step = 0.0;
  for (int k = 0; k < P::kCount; ++k) {
    step = std::max(step, std::abs(to[k] - from[k]));
    const Bounds bounds = problem.BoundsOf(k);
    const bool within = to[k] >= bounds.low && to[k] <= bounds.high;
    if (problem.rules[k].free && !within) return std::nullopt;
  }
  return step < kLargestStep ? std::optional(step) : std::nullopt;
}

// Of a standard deviation of every free parameter: the optimum.
inline constexpr double kAtRest = 1e-9;

// Newton's steps take two gradients a parameter: of a beam's 26 that is dearer than its fit.
template <class P>
inline constexpr bool kEndsByNewton = P::kCount <= 12;

// Newton's steps as long as they are small, the gradient falls and the cost is no worse. Whether
// they came to an end.
template <class P, class NoWorse>
bool FinishByNewton(const P& problem, ValuesOf<P>& theta, const NoWorse& no_worse) {
  constexpr int kSteps = 4;
  constexpr double kDone = 1e-13;
  auto at = NewtonEquationsAt(problem, theta);
  double left = GradientLeft(problem, theta, at);
  for (int i = 0; i < kSteps && left > kDone; ++i) {
    const ValuesOf<P> next = NewtonStep(problem, theta, at);
    const auto step = SmallStep(problem, theta, next);
    if (!step || *step == 0.0 || !no_worse(next)) break;
    at = NewtonEquationsAt(problem, next);
    const double then = GradientLeft(problem, next, at);
    if (!(then < left)) break;
    left = then;
    theta = next;
  }
  return left < kAtRest;
}

// A few steps more, as long as they are small and the cost does not grow beyond rounding; where
// they come to no end, or to it by parts of the way, Newton's.
template <class P>
[[nodiscard]] ValuesOf<P> Polish(const P& problem, ValuesOf<P> theta) {
  constexpr int kSteps = 8;
  constexpr double kDone = 1e-13, kNearlyDone = 1e-11;
  constexpr double kSlow = 0.1;  // of the step before
  double former = std::numeric_limits<double>::infinity();
  const auto no_worse = [&problem, cost = HalfChiSquaredOf(problem, theta)](const auto& next) {
    return HalfChiSquaredOf(problem, next) <= cost * (1.0 + 1e-12) + 1e-20;
  };
  if constexpr (TellsBend<P>) {
    if (FinishByNewton(problem, theta, no_worse)) return theta;
  }
  for (int i = 0; i < kSteps; ++i) {
    const ValuesOf<P> next = GaussNewtonStep(problem, theta);
    const auto step = SmallStep(problem, theta, next);
    if (!step || !no_worse(next)) break;
    theta = next;
    if (*step < (i + 1 < kSteps ? kDone : kNearlyDone)) return theta;
    const bool slow = *step > kSlow * former;
    former = *step;
    if constexpr (kEndsByNewton<P>) {
      if (slow && FinishByNewton(problem, theta, no_worse)) return theta;
    }
  }
  if constexpr (kEndsByNewton<P>) FinishByNewton(problem, theta, no_worse);
  return theta;
}

// Whether theta is the optimum.
template <class P>
[[nodiscard]] bool AtRest(const P& problem, const ValuesOf<P>& theta) {
  return GradientLeft(problem, theta, NormalEquationsAt(problem, theta)) < kAtRest;
}

}  // namespace lightcal::fit
