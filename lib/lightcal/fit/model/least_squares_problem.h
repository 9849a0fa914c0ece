// SPDX-License-Identifier: Apache-2.0
// The one least-squares problem of this room (least_squares.h solves it): minimises
//   1/2 sum_i rho(r_i(theta)^2) + 1/2 sum_k ((theta_k - mean_k)/sd_k)^2
// of few parameters. A problem P tells
//   P::kCount                       how many parameters there are
//   problem.rules                   std::array<ParameterRule, kCount>: free or held, priors
//   problem.BoundsOf(k)             where a free one must stay
//   problem.RowCount()              how many rows
//   problem.Residual(i, theta, r)   row i over its sigma, T = double or Jet; false: it has no value
// so that a further parameter is a line in P's rules and its place in the row's law. Where rows are
// many and their derivatives short, P may also tell
//   problem.Differentiate(i, theta, r, gradient)   the same with its derivatives, in doubles
//   problem.Bend(i, theta, r, gradient, bend)      and with its second ones: Newton's steps then
//                                                  cost no more than Gauss and Newton's
// Internal to this room: needs Eigen and Ceres's Jet alone.
#pragma once

#include <ceres/jet.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

#include "lightcal/fit/model/parameter.h"

namespace lightcal::fit {

template <class P>
using ValuesOf = std::array<double, P::kCount>;
template <class P>
using VectorOf = Eigen::Matrix<double, P::kCount, 1>;
template <class P>
using SquareOf = Eigen::Matrix<double, P::kCount, P::kCount>;
template <class P>
using RowsOf = Eigen::Matrix<double, Eigen::Dynamic, P::kCount>;

template <class P>
[[nodiscard]] bool HasPrior(const P& problem, int k) {
  return problem.rules[k].free && problem.rules[k].prior_sd > 0.0;
}

// Whether P tells its rows' second derivatives.
template <class P>
concept TellsBend = requires(const P& problem, double* out) {
  { problem.Bend(std::size_t{}, out, out, out, out) } -> std::same_as<bool>;
};

// Whether a free parameter lies on a bound of its own or beyond.
template <class P>
[[nodiscard]] bool AtBound(const P& problem, const ValuesOf<P>& theta, int k) {
  const Bounds bounds = problem.BoundsOf(k);
  return problem.rules[k].free && (theta[k] <= bounds.low || theta[k] >= bounds.high);
}

// Row i at theta, infinite where it has no value.
template <class P>
[[nodiscard]] double ResidualAt(const P& problem, std::size_t i, const double* theta) {
  double residual = 0.0;
  return problem.Residual(i, theta, &residual) ? residual : std::numeric_limits<double>::infinity();
}

// A row's value at theta and its derivatives by every parameter of P; false: it has none.
template <class P, class Row>
bool DifferentiateByJets(const Row& row, const double* theta, double* residual, double* gradient) {
  using Jet = ceres::Jet<double, P::kCount>;
  std::array<Jet, P::kCount> variables;
  for (int k = 0; k < P::kCount; ++k) {  // in place: what is made beside them is copied
    variables[k].a = theta[k];
    variables[k].v[k] = 1.0;
  }
  Jet out(0.0);
  const bool has_value = row(variables.data(), &out);
  *residual = out.a;
  std::copy_n(out.v.data(), P::kCount, gradient);
  return has_value;
}

// Row i at theta and its derivatives; infinite, and those 0, where it has no value.
template <class P>
double DifferentiateAt(const P& problem, std::size_t i, const double* theta, double* gradient) {
  double value = 0.0;
  bool has_value = false;
  if constexpr (requires { problem.Differentiate(i, theta, &value, gradient); }) {
    has_value = problem.Differentiate(i, theta, &value, gradient);
  } else {
    has_value = DifferentiateByJets<P>(
        [&](const auto* at, auto* out) { return problem.Residual(i, at, out); }, theta, &value,
        gradient);
  }
  if (has_value) return value;
  std::fill_n(gradient, P::kCount, 0.0);
  return std::numeric_limits<double>::infinity();
}

// sum ((theta_k - mean_k)/sd_k)^2 of free parameters.
template <class P>
[[nodiscard]] double PriorChiSquaredOf(const P& problem, const ValuesOf<P>& theta) {
  double sum = 0.0;
  for (int k = 0; k < P::kCount; ++k) {
    if (!HasPrior(problem, k)) continue;
    const double r = (theta[k] - problem.rules[k].prior_mean) / problem.rules[k].prior_sd;
    sum += r * r;
  }
  return sum;
}

// 1/2 sum r_i^2 with the priors of free parameters.
template <class P>
[[nodiscard]] double HalfChiSquaredOf(const P& problem, const ValuesOf<P>& theta) {
  double sum = 0.0;
  for (std::size_t i = 0; i < problem.RowCount(); ++i) {
    const double r = ResidualAt(problem, i, theta.data());
    sum += r * r;
  }
  return 0.5 * (sum + PriorChiSquaredOf(problem, theta));
}

}  // namespace lightcal::fit
