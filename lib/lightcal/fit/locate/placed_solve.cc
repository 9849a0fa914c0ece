// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/placed_solve.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lightcal/fit/model/costs/normal_prior_cost.h"
#include "lightcal/fit/model/costs/placed_illuminance_cost.h"
#include "lightcal/fit/model/truncated_normal.h"

namespace lightcal::fit {
namespace {

using Vector = Eigen::Matrix<double, kPlacedParameters, 1>;
using Matrix = Eigen::Matrix<double, kPlacedParameters, kPlacedParameters>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, kPlacedParameters>;

template <class T>
bool EvaluateRow(const PlacedEstimation& estimation, const PlacedRow& row, const T* theta,
                 T* residual) {
  const PlacedIlluminanceCost cost{&row, &estimation.aim};
  return cost(&theta[kPlacedLnIntensity], &theta[kPlacedX], &theta[kPlacedAmbient],
              &theta[kPlacedOffset], residual);
}

bool IsFree(const PlacedEstimation& estimation, int k) {
  if (k == kPlacedAmbient) return estimation.ambient.free;
  return k != kPlacedOffset || estimation.offset.free;
}

const ParameterRule* RuleOf(const PlacedEstimation& estimation, int k) {
  if (k == kPlacedAmbient) return &estimation.ambient;
  return k == kPlacedOffset ? &estimation.offset : nullptr;
}

struct Linearised {
  Rows jacobian;  // whitened rows, then a row for each prior; columns of held parameters are zero
  Eigen::VectorXd residual;
};

// False where some row has no value.
bool Linearise(const PlacedEstimation& estimation, const PlacedTheta& theta, double row_scale,
               Linearised& out) {
  using Jet = ceres::Jet<double, kPlacedParameters>;
  std::array<Jet, kPlacedParameters> variables;
  for (int k = 0; k < kPlacedParameters; ++k) variables[k] = Jet(theta[k], k);
  const auto n = static_cast<Eigen::Index>(estimation.rows.size());
  out.jacobian = Rows::Zero(n + 2, kPlacedParameters);
  out.residual = Eigen::VectorXd::Zero(n + 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    Jet residual;
    if (!EvaluateRow(estimation, estimation.rows[static_cast<std::size_t>(i)], variables.data(),
                     &residual)) {
      return false;
    }
    out.residual[i] = residual.a / row_scale;
    for (int k = 0; k < kPlacedParameters; ++k) {
      if (IsFree(estimation, k)) out.jacobian(i, k) = residual.v[k] / row_scale;
    }
  }
  for (int k = kPlacedAmbient; k <= kPlacedOffset; ++k) {
    const ParameterRule& rule = *RuleOf(estimation, k);
    if (!rule.free || !(rule.prior_sd > 0.0)) continue;
    const Eigen::Index row = n + k - kPlacedAmbient;
    out.jacobian(row, k) = 1.0 / rule.prior_sd;
    out.residual[row] = (theta[k] - rule.prior_mean) / rule.prior_sd;
  }
  return out.jacobian.allFinite() && out.residual.allFinite();
}

// Inverse of J^T J over the columns in use, by columns of unit length; nothing when singular.
std::optional<Matrix> InverseNormal(const Rows& jacobian) {
  Vector scale = jacobian.colwise().norm().transpose();
  for (int k = 0; k < kPlacedParameters; ++k) {
    if (!(scale[k] > 0.0)) scale[k] = 1.0;
  }
  const Rows scaled = jacobian * scale.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinV);
  const Eigen::VectorXd& singular = svd.singularValues();
  Matrix inverse = Matrix::Zero();
  int used = 0;
  for (int k = 0; k < kPlacedParameters; ++k) used += jacobian.col(k).squaredNorm() > 0.0 ? 1 : 0;
  if (used > singular.size()) return std::nullopt;
  for (int j = 0; j < used; ++j) {
    if (!(singular[j] > 1e-13 * singular[0])) return std::nullopt;
    const Vector v = svd.matrixV().col(j) / singular[j];
    inverse += v * v.transpose();
  }
  return scale.cwiseInverse().asDiagonal() * inverse * scale.cwiseInverse().asDiagonal();
}

ceres::Solver::Options SolverOptions() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-10;
  options.gradient_tolerance = 1e-13;
  return options;
}

void AddRows(const PlacedEstimation& estimation, PlacedTheta& theta, ceres::Problem& problem) {
  for (const PlacedRow& row : estimation.rows) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PlacedIlluminanceCost, 1, 1, 3, 1, 1>(
                                 new PlacedIlluminanceCost{&row, &estimation.aim}),
                             nullptr, &theta[kPlacedLnIntensity], &theta[kPlacedX],
                             &theta[kPlacedAmbient], &theta[kPlacedOffset]);
  }
  for (const int k : {kPlacedAmbient, kPlacedOffset}) {
    const ParameterRule& rule = *RuleOf(estimation, k);
    if (!rule.free) {
      problem.SetParameterBlockConstant(&theta[k]);
    } else if (rule.prior_sd > 0.0) {
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<NormalPriorCost, 1, 1>(
                                   new NormalPriorCost{rule.prior_mean, rule.prior_sd}),
                               nullptr, &theta[k]);
    }
  }
  if (estimation.ambient.free) problem.SetParameterLowerBound(&theta[kPlacedAmbient], 0, 0.0);
}

// Ceres leaves half of the digits (see solve.cc): a few small steps more, E0 at its bound held.
PlacedTheta Polish(const PlacedEstimation& estimation, PlacedTheta theta) {
  constexpr int kSteps = 4;
  constexpr double kLargestStep = 1e-3;
  const double cost = PlacedChiSquared(estimation, theta);
  for (int i = 0; i < kSteps; ++i) {
    Linearised at;
    if (!Linearise(estimation, theta, 1.0, at)) return theta;
    if (theta[kPlacedAmbient] <= 0.0) at.jacobian.col(kPlacedAmbient).setZero();
    const auto inverse = InverseNormal(at.jacobian);
    if (!inverse) return theta;
    const Vector step = *inverse * (at.jacobian.transpose() * at.residual);
    if (!(step.cwiseAbs().maxCoeff() < kLargestStep)) return theta;
    PlacedTheta next = theta;
    for (int k = 0; k < kPlacedParameters; ++k) next[k] -= step[k];
    if (next[kPlacedAmbient] < 0.0 ||
        !(PlacedChiSquared(estimation, next) <= cost * (1.0 + 1e-12) + 1e-20)) {
      return theta;
    }
    theta = next;
  }
  return theta;
}

// A free E0 cannot be negative: its marginal becomes the normal truncated at zero, the others
// follow by their regression on it, and how far that moves the mean from the estimate counts as
// error.
void CutAmbient(const Linearised& at, double estimate, const Matrix& covariance, Matrix& total) {
  const double variance = covariance(kPlacedAmbient, kPlacedAmbient);
  if (!(variance > 0.0)) return;
  const Vector step = covariance * (at.jacobian.transpose() * at.residual);
  const TruncatedNormal truncated =
      TruncateAtZero(estimate - step[kPlacedAmbient], std::sqrt(variance));
  const Vector regression = covariance.col(kPlacedAmbient) / variance;
  const double shift = truncated.mean - estimate;
  total += regression * regression.transpose() * (truncated.variance - variance + shift * shift);
}

double DistanceOf(const PlacedRow& row, const PlacedTheta& theta) {
  if (!row.position) return row.distance;
  return Length(Vec3{theta[kPlacedX], theta[kPlacedY], theta[kPlacedZ]} - *row.position);
}

void AddConsidered(const PlacedEstimation& estimation, const PlacedTheta& theta,
                   const PlacedUncertainty& input, const Linearised& at, const Matrix& covariance,
                   Matrix& total) {
  for (const Consider& influence : input.considered) {
    Eigen::VectorXd whitened = Eigen::VectorXd::Zero(at.residual.size());
    for (std::size_t i = 0; i < estimation.rows.size(); ++i) {
      const PlacedRow& row = estimation.rows[i];
      if (row.form != ReadingRow::Form::kLog || !(row.direct_gain > 0.0)) continue;
      whitened[static_cast<Eigen::Index>(i)] =
          influence.relative * std::pow(DistanceOf(row, theta), influence.distance_power) /
          (row.sigma * input.row_scale);
    }
    const Vector shift = covariance * (at.jacobian.transpose() * whitened);
    total += shift * shift.transpose();
  }
}

}  // namespace

Result<PlacedTheta> SolvePlaced(const PlacedEstimation& estimation, const PlacedTheta& start) {
  PlacedTheta theta = start;
  ceres::Problem::Options problem_options;
  problem_options.disable_all_safety_checks = true;
  ceres::Problem problem(problem_options);
  AddRows(estimation, theta, problem);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(), &problem, &summary);
  const bool finite =
      std::all_of(theta.begin(), theta.end(), [](double x) { return std::isfinite(x); });
  if (!summary.IsSolutionUsable() || !finite) {
    return Failed("no_convergence", "fit", "the solver found no position: " + summary.message);
  }
  return Polish(estimation, theta);
}

std::vector<double> PlacedResiduals(const PlacedEstimation& estimation, const PlacedTheta& theta) {
  std::vector<double> out;
  out.reserve(estimation.rows.size());
  for (const PlacedRow& row : estimation.rows) {
    double residual = 0.0;
    if (!EvaluateRow(estimation, row, theta.data(), &residual)) {
      residual = std::numeric_limits<double>::infinity();
    }
    out.push_back(residual);
  }
  return out;
}

double PlacedChiSquared(const PlacedEstimation& estimation, const PlacedTheta& theta) {
  double sum = 0.0;
  for (const double r : PlacedResiduals(estimation, theta)) sum += r * r;
  for (const int k : {kPlacedAmbient, kPlacedOffset}) {
    const ParameterRule& rule = *RuleOf(estimation, k);
    if (!rule.free || !(rule.prior_sd > 0.0)) continue;
    const double z = (theta[k] - rule.prior_mean) / rule.prior_sd;
    sum += z * z;
  }
  return sum;
}

Result<PlacedCovariance> EstimatePlacedCovariance(const PlacedEstimation& estimation,
                                                  const PlacedTheta& theta,
                                                  const PlacedUncertainty& input) {
  const auto refuse = [] {
    return Refused("underdetermined", "fit", "the readings do not determine the lamp's position");
  };
  Linearised at;
  if (!Linearise(estimation, theta, input.row_scale, at)) return refuse();
  Rows rows = at.jacobian;
  if (input.position_sd > 0.0) {
    rows.conservativeResize(rows.rows() + 3, Eigen::NoChange);
    rows.bottomRows(3).setZero();
    for (int k = 0; k < 3; ++k) rows(rows.rows() - 3 + k, kPlacedX + k) = 1.0 / input.position_sd;
  }
  const auto inverse = InverseNormal(rows);
  if (!inverse) return refuse();
  Matrix total = *inverse;
  if (estimation.ambient.free) CutAmbient(at, theta[kPlacedAmbient], *inverse, total);
  AddConsidered(estimation, theta, input, at, *inverse, total);
  PlacedCovariance out{};
  for (int i = 0; i < kPlacedParameters; ++i) {
    for (int j = 0; j < kPlacedParameters; ++j) {
      out[i * kPlacedParameters + j] = 0.5 * (total(i, j) + total(j, i));
    }
  }
  return out;
}

double PlacedCondition(const PlacedEstimation& estimation, const PlacedTheta& theta) {
  const double infinite = std::numeric_limits<double>::infinity();
  Linearised at;
  if (!Linearise(estimation, theta, 1.0, at)) return infinite;
  const auto ambient_row = static_cast<Eigen::Index>(estimation.rows.size());
  at.jacobian.row(ambient_row).setZero();
  std::vector<int> columns;
  for (int k = 0; k < kPlacedParameters; ++k) {
    if (IsFree(estimation, k)) columns.push_back(k);
  }
  const auto p = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd scaled(at.jacobian.rows(), p);
  for (Eigen::Index j = 0; j < p; ++j) {
    const auto column = at.jacobian.col(columns[static_cast<std::size_t>(j)]);
    const double length = column.norm();
    if (!(length > 0.0)) return infinite;
    scaled.col(j) = column / length;
  }
  const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(scaled).singularValues();
  return singular[p - 1] > 1e-300 ? singular[0] / singular[p - 1] : infinite;
}

}  // namespace lightcal::fit
