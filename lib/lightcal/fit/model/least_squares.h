// SPDX-License-Identifier: Apache-2.0
// Solves the one least-squares problem of this room (least_squares_problem.h) and says how well its
// parameters are known.
// Internal to this room: needs Eigen and Ceres's header-only parts alone (least_squares.cc: Ceres).
#pragma once

#include <ceres/tiny_solver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/model/least_squares_problem.h"
#include "lightcal/fit/model/parameter.h"
#include "lightcal/fit/model/polish.h"
#include "lightcal/fit/model/small_cholesky.h"
#include "lightcal/fit/model/truncated_normal.h"

namespace lightcal::fit {

// ---- solving ----

// The rows and priors as TinySolver takes them, column-major; what is not free has no derivative.
template <class P>
class TinyRows {
 public:
  using Scalar = double;
  enum : int { NUM_PARAMETERS = P::kCount, NUM_RESIDUALS = Eigen::Dynamic };

  TinyRows(const P& problem, const std::array<bool, P::kCount>& held) : problem_(problem) {
    for (int k = 0; k < P::kCount; ++k) free_[k] = problem.rules[k].free && !held[k];
  }
  [[nodiscard]] int NumResiduals() const {
    return static_cast<int>(problem_.RowCount()) + P::kCount;
  }
  bool operator()(const double* theta, double* residuals, double* jacobian) const {
    const int n = NumResiduals();
    const int rows = n - P::kCount;
    std::array<double, P::kCount> gradient;
    for (int i = 0; i < rows; ++i) {
      const auto row = static_cast<std::size_t>(i);
      if (jacobian == nullptr) {
        residuals[i] = ResidualAt(problem_, row, theta);
      } else {
        residuals[i] = DifferentiateAt(problem_, row, theta, gradient.data());
        for (int k = 0; k < P::kCount; ++k) jacobian[i + k * n] = free_[k] ? gradient[k] : 0.0;
      }
      if (!std::isfinite(residuals[i])) return false;
    }
    for (int k = 0; k < P::kCount; ++k) {
      const ParameterRule& rule = problem_.rules[k];
      const double weight = free_[k] && rule.prior_sd > 0.0 ? 1.0 / rule.prior_sd : 0.0;
      residuals[rows + k] = weight * (theta[k] - rule.prior_mean);
      for (int j = 0; jacobian != nullptr && j < P::kCount; ++j) {
        jacobian[rows + k + j * n] = j == k ? weight : 0.0;
      }
    }
    return true;
  }

 private:
  const P& problem_;
  std::array<bool, P::kCount> free_{};
};

// The squared-loss optimum to 1e-7 of a parameter by ceres::TinySolver, which knows no bounds,
// `held` parameters kept at their start. Where its steps come to no end (rows that bend), the
// polish finishes them. Absent where that is no optimum either.
template <class P>
[[nodiscard]] std::optional<ValuesOf<P>> SolveTiny(const P& problem, const ValuesOf<P>& start,
                                                   const std::array<bool, P::kCount>& held = {}) {
  const TinyRows<P> rows(problem, held);
  ceres::TinySolver<TinyRows<P>> solver;
  solver.options.max_num_iterations = 40;
  solver.options.initial_trust_region_radius = 1e8;
  solver.options.gradient_tolerance = 1e-9;
  solver.options.function_tolerance = 1e-10;
  solver.options.parameter_tolerance = 1e-7;  // the polish takes the last digits
  VectorOf<P> x = Eigen::Map<const VectorOf<P>>(start.data());
  const auto& summary = solver.Solve(rows, &x);
  if (!x.allFinite() || !std::isfinite(summary.final_cost)) return std::nullopt;
  ValuesOf<P> out;
  std::copy_n(x.data(), P::kCount, out.begin());
  if (summary.status != ceres::TinySolver<TinyRows<P>>::HIT_MAX_ITERATIONS) return out;
  if constexpr (kEndsByNewton<P>) {
    out = Polish(problem, out);
    if (AtRest(problem, out)) return out;
  }
  return std::nullopt;
}

// m x = b over the first n rows, where m may be positive in some directions alone.
template <int N>
[[nodiscard]] std::array<double, N> SolveSemidefinite(const SmallMatrix<N>& m, int n,
                                                      const std::array<double, N>& b) {
  Eigen::Matrix<double, N, N> whole = Eigen::Matrix<double, N, N>::Identity();
  Eigen::Matrix<double, N, 1> right = Eigen::Matrix<double, N, 1>::Zero();
  for (int i = 0; i < n; ++i) {
    right[i] = b[i];
    for (int j = 0; j <= i; ++j) whole(i, j) = whole(j, i) = m[i * N + j];
  }
  const Eigen::Matrix<double, N, 1> x = whole.ldlt().solve(right);
  std::array<double, N> out;
  std::copy_n(x.data(), N, out.begin());
  return out;
}

// The same by Newton's steps, damped where they would raise the cost; Gauss and Newton's where the
// cost does not bend upwards. Absent where it comes to no end, or to no minimum.
template <TellsBend P>
[[nodiscard]] std::optional<ValuesOf<P>> SolveByNewton(const P& problem, ValuesOf<P> theta,
                                                       const std::array<bool, P::kCount>& held,
                                                       double last_step) {
  constexpr int kSteps = 40;
  constexpr double kLeastDamping = 1e-3, kMostDamping = 1e8, kDampingStep = 10.0;
  std::array<int, P::kCount> moves{};  // the parameters that may
  int count = 0;
  for (int k = 0; k < P::kCount; ++k) {
    if (problem.rules[k].free && !held[k]) moves[count++] = k;
  }
  double damping = 0.0;
  SecondOrder<P> at = SecondOrderAt(problem, theta);
  if (!std::isfinite(at.cost)) return std::nullopt;
  for (int i = 0; i < kSteps; ++i) {
    ValuesOf<P> scale{}, downhill{};
    for (int a = 0; a < count; ++a) {
      const double curvature = at.normal(moves[a], moves[a]);
      if (!(curvature > 0.0)) return std::nullopt;
      scale[a] = 1.0 / std::sqrt(curvature);
      downhill[a] = -scale[a] * at.gradient[moves[a]];
    }
    const auto scaled = [&](const SquareOf<P>& curvature) {
      SmallMatrix<P::kCount> out;
      for (int a = 0; a < count; ++a) {
        for (int b = 0; b <= a; ++b) {
          out[a * P::kCount + b] = scale[a] * curvature(moves[a], moves[b]) * scale[b];
        }
        out[a * P::kCount + a] += damping;
      }
      return out;
    };
    ValuesOf<P> step = downhill;
    SmallMatrix<P::kCount> bent = scaled(at.bend);
    const bool minimum = SolvePositive<P::kCount>(bent, count, step);
    if (!minimum) step = SolveSemidefinite<P::kCount>(scaled(at.normal), count, downhill);
    ValuesOf<P> next = theta;
    double longest = 0.0;
    for (int a = 0; a < count; ++a) {
      if (!std::isfinite(step[a])) return std::nullopt;
      next[moves[a]] += scale[a] * step[a];
      longest = std::max(longest, std::abs(step[a]));
    }
    const bool done = minimum && damping == 0.0 && longest < last_step;
    if (done) return next;
    SecondOrder<P> then = SecondOrderAt(problem, next);
    if (!(then.cost <= at.cost * (1.0 + 1e-12) + 1e-20)) {
      damping = std::max(kLeastDamping, damping * kDampingStep);
      if (damping > kMostDamping) return std::nullopt;
      continue;
    }
    damping = damping > kLeastDamping ? damping / kDampingStep : 0.0;
    theta = next;
    at = std::move(then);
  }
  return std::nullopt;
}

// By Newton's steps, where those come to no end by TinySolver's and the polish.
template <TellsBend P>
[[nodiscard]] std::optional<ValuesOf<P>> SolveNear(const P& problem, const ValuesOf<P>& start,
                                                   const std::array<bool, P::kCount>& held,
                                                   double last_step) {
  if (const auto theta = SolveByNewton(problem, start, held, last_step)) return theta;
  const auto theta = SolveTiny(problem, start, held);
  return theta ? std::optional(Polish(problem, *theta)) : std::nullopt;
}

// The optimum where parameter k cannot fall below 0, by solve(start, held), which knows no bounds:
// where it falls below, that with k held at 0, if more of it would be no better. Absent otherwise.
template <class P, class Solver>
[[nodiscard]] std::optional<ValuesOf<P>> SolveNotBelowZero(const P& problem, int k,
                                                           const ValuesOf<P>& start,
                                                           const Solver& solve) {
  std::array<bool, P::kCount> held{};
  std::optional<ValuesOf<P>> theta = solve(start, held);
  if (!theta || !problem.rules[k].free || (*theta)[k] >= 0.0) return theta;
  held[k] = true;
  (*theta)[k] = 0.0;
  theta = solve(*theta, held);
  return theta && GradientAt(problem, *theta)[k] >= 0.0 ? theta : std::nullopt;
}

// What the full solver sees of any problem.
struct ErasedProblem {
  std::span<const ParameterRule> rules;
  std::vector<Bounds> bounds;  // beside them
  std::size_t rows = 0;
  // Row i and, unless it is null, its gradient. False: it has no value.
  std::function<bool(std::size_t i, const double* theta, double* residual, double* gradient)> row;
};
// Fails: no_convergence ("the solver found no <what>").
[[nodiscard]] Result<void> MinimiseInFull(const ErasedProblem& problem, const FullSolver& how,
                                          const std::string& what, double* theta);

// By Ceres from `start`, free parameters within their bounds.
template <class P>
[[nodiscard]] Result<ValuesOf<P>> SolveInFullBy(const P& problem, ValuesOf<P> theta,
                                                const FullSolver& how, const std::string& what) {
  ErasedProblem erased{problem.rules, {}, problem.RowCount(), {}};
  for (int k = 0; k < P::kCount; ++k) erased.bounds.push_back(problem.BoundsOf(k));
  erased.row = [&problem](std::size_t i, const double* at, double* residual, double* gradient) {
    *residual = gradient == nullptr ? ResidualAt(problem, i, at)
                                    : DifferentiateAt(problem, i, at, gradient);
    return std::isfinite(*residual);
  };
  if (auto solved = MinimiseInFull(erased, how, what, theta.data()); !solved) {
    return tl::unexpected(std::move(solved).error());
  }
  return how.polish ? Polish(problem, theta) : theta;
}

// ---- how well the parameters are known ----

// Rows over their sigmas (times `row_scale`), then one row for each parameter's prior.
template <class P>
struct Linearised {
  RowsOf<P> jacobian;  // by every parameter, held ones too
  Eigen::VectorXd residual;
};

template <class P>
[[nodiscard]] Linearised<P> Linearise(const P& problem, const ValuesOf<P>& theta,
                                      double row_scale = 1.0) {
  const auto n = static_cast<Eigen::Index>(problem.RowCount());
  Linearised<P> out{RowsOf<P>::Zero(n + P::kCount, P::kCount),
                    Eigen::VectorXd::Zero(n + P::kCount)};
  VectorOf<P> gradient;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(i);
    out.residual[i] = DifferentiateAt(problem, row, theta.data(), gradient.data()) / row_scale;
    out.jacobian.row(i) = gradient.transpose() / row_scale;
  }
  for (int k = 0; k < P::kCount; ++k) {
    if (!HasPrior(problem, k)) continue;
    const ParameterRule& rule = problem.rules[k];
    out.jacobian(n + k, k) = 1.0 / rule.prior_sd;
    out.residual[n + k] = (theta[k] - rule.prior_mean) / rule.prior_sd;
  }
  return out;
}

// The upper triangle R of the QR decomposition of rows takes one row more (Givens rotations: O(1)
// memory and as stable as Householder for weights of any span).
template <int N>
void RotateInto(Eigen::Matrix<double, N, N>& r, Eigen::Matrix<double, N, 1> row) {
  for (int k = 0; k < N; ++k) {
    if (row[k] == 0.0) continue;
    const double square = r(k, k) * r(k, k) + row[k] * row[k];
    const double length = std::isnormal(square) ? std::sqrt(square) : std::hypot(r(k, k), row[k]);
    const double c = r(k, k) / length;
    const double s = row[k] / length;
    for (int j = k; j < N; ++j) {
      const double upper = r(k, j);
      r(k, j) = c * upper + s * row[j];
      row[j] = c * row[j] - s * upper;
    }
  }
}

template <int N>
[[nodiscard]] Eigen::Matrix<double, N, N> TriangleOf(
    const Eigen::Matrix<double, Eigen::Dynamic, N>& rows) {
  Eigen::Matrix<double, N, N> r = Eigen::Matrix<double, N, N>::Zero();
  for (Eigen::Index i = 0; i < rows.rows(); ++i) RotateInto<N>(r, rows.row(i));
  return r;
}

// The triangle over the free parameters; that of a held one is the unit matrix's. The priors' rows,
// one entry each, are a triangle already.
template <class P>
[[nodiscard]] SquareOf<P> FreeTriangle(const P& problem, const Linearised<P>& at) {
  const Eigen::Index n = at.jacobian.rows() - P::kCount;
  SquareOf<P> r = SquareOf<P>::Zero();
  for (int k = 0; k < P::kCount; ++k) {
    r(k, k) = problem.rules[k].free ? at.jacobian(n + k, k) : 1.0;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    VectorOf<P> row = at.jacobian.row(i);
    for (int k = 0; k < P::kCount; ++k) {
      if (!problem.rules[k].free) row[k] = 0.0;
    }
    RotateInto<P::kCount>(r, row);
  }
  return r;
}

// R^-1 of an upper triangle.
template <int N>
[[nodiscard]] Eigen::Matrix<double, N, N> InverseOfTriangle(const Eigen::Matrix<double, N, N>& r) {
  Eigen::Matrix<double, N, N> inverse = Eigen::Matrix<double, N, N>::Zero();
  for (int j = 0; j < N; ++j) {
    inverse(j, j) = 1.0 / r(j, j);
    for (int i = j - 1; i >= 0; --i) {
      double sum = 0.0;
      for (int k = i + 1; k <= j; ++k) sum += r(i, k) * inverse(k, j);
      inverse(i, j) = -sum / r(i, i);
    }
  }
  return inverse;
}

// Inverse of J^T J of rows and priors by QR (weights may span 1e12), zero for held parameters.
// Absent where some free parameter is determined by no row and no prior.
template <class P>
[[nodiscard]] std::optional<SquareOf<P>> CovarianceAt(const P& problem, const Linearised<P>& at) {
  const SquareOf<P> r = FreeTriangle(problem, at);
  if (!r.allFinite() || !(r.diagonal().cwiseAbs().minCoeff() > 1e-300)) return std::nullopt;
  const SquareOf<P> inverse = InverseOfTriangle<P::kCount>(r);
  SquareOf<P> covariance = SquareOf<P>::Zero();
  for (int i = 0; i < P::kCount; ++i) {
    if (!problem.rules[i].free) continue;
    for (int j = 0; j <= i; ++j) {
      if (!problem.rules[j].free) continue;
      double sum = 0.0;
      for (int k = i; k < P::kCount; ++k) sum += inverse(i, k) * inverse(j, k);
      covariance(i, j) = covariance(j, i) = sum;
    }
  }
  return covariance;
}

// How far an influence on the whitened rows moves the estimate (Schmidt's consider covariance).
template <class P>
[[nodiscard]] VectorOf<P> Carried(const Linearised<P>& at, const SquareOf<P>& covariance,
                                  const Eigen::VectorXd& whitened) {
  return -covariance * (at.jacobian.transpose() * whitened);
}

// The normal marginal of parameter k becomes the one truncated at 0.
template <class P>
[[nodiscard]] TruncatedNormal CutAtZero(const Linearised<P>& at, const SquareOf<P>& covariance,
                                        int k, double estimate) {
  const double step = (covariance * (at.jacobian.transpose() * at.residual))[k];
  return TruncateAtZero(estimate - step, std::sqrt(covariance(k, k)));
}

template <class P>
[[nodiscard]] std::array<double, std::size_t{P::kCount} * P::kCount> Symmetric(
    const SquareOf<P>& m) {
  std::array<double, std::size_t{P::kCount} * P::kCount> out{};
  for (int i = 0; i < P::kCount; ++i) {
    for (int j = 0; j < P::kCount; ++j) out[i * P::kCount + j] = 0.5 * (m(i, j) + m(j, i));
  }
  return out;
}

// Ratio of the largest to the smallest singular value of these columns, each scaled to unit length;
// infinite where one is zero.
template <int N>
[[nodiscard]] double ConditionOf(Eigen::Matrix<double, Eigen::Dynamic, N> rows,
                                 const std::vector<int>& columns) {
  const double infinite = std::numeric_limits<double>::infinity();
  if (rows.rows() < static_cast<Eigen::Index>(columns.size())) return infinite;
  for (const int k : columns) {
    const double length = rows.col(k).norm();
    if (!(length > 0.0)) return infinite;
    rows.col(k) /= length;
  }
  const Eigen::Matrix<double, N, N> r = TriangleOf<N>(rows);
  Eigen::MatrixXd chosen(N, static_cast<Eigen::Index>(columns.size()));
  for (Eigen::Index j = 0; j < chosen.cols(); ++j) {
    chosen.col(j) = r.col(columns[static_cast<std::size_t>(j)]);
  }
  const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(chosen).singularValues();
  const double least = singular[singular.size() - 1];
  return least > 1e-300 ? singular[0] / least : infinite;
}

}  // namespace lightcal::fit
