// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/uncertainty.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lightcal/fit/model/truncated_normal.h"

namespace lightcal::fit {
namespace {

using Matrix3 = Eigen::Matrix3d;
using Vector3 = Eigen::Vector3d;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3>;

struct Linearised {
  Rows jacobian;  // whitened, all three columns
  Eigen::VectorXd residual;
};

Linearised Linearise(const Estimation& estimation, const Theta& theta, double row_scale) {
  const auto n = static_cast<Eigen::Index>(estimation.rows.size());
  Linearised out{Rows(n, 3), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const RowDerivative row = DifferentiateRow(estimation.rows[i], theta);
    out.residual[i] = row.residual / row_scale;
    for (int k = 0; k < kParameters; ++k) out.jacobian(i, k) = row.gradient[k] / row_scale;
  }
  return out;
}

// Upper triangle R of the QR decomposition of rows (Givens rotations, one row at a time: O(1)
// memory and as stable as Householder for weights of any span).
Matrix3 TriangleOf(const Rows& rows) {
  Matrix3 r = Matrix3::Zero();
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    Vector3 row = rows.row(i);
    for (int k = 0; k < 3; ++k) {
      if (row[k] == 0.0) continue;
      const double length = std::hypot(r(k, k), row[k]);
      const double c = r(k, k) / length;
      const double s = row[k] / length;
      for (int j = k; j < 3; ++j) {
        const double upper = r(k, j);
        r(k, j) = c * upper + s * row[j];
        row[j] = c * row[j] - s * upper;
      }
    }
  }
  return r;
}

Rows WithPriors(const Estimation& estimation, const Rows& jacobian) {
  Rows rows = Rows::Zero(jacobian.rows() + 3, 3);
  rows.topRows(jacobian.rows()) = jacobian;
  for (int k = 0; k < kParameters; ++k) {
    const ParameterRule& rule = estimation.rules[k];
    if (!rule.free) rows.col(k).setZero();
    if (!rule.free) rows(jacobian.rows() + k, k) = 1.0;  // keeps the triangle invertible
    if (rule.free && rule.prior_sd > 0.0) rows(jacobian.rows() + k, k) = 1.0 / rule.prior_sd;
  }
  return rows;
}

// Replaces the normal marginal of E0 by the one truncated at 0 and carries the change to the others
// by their regression on E0. E0's own entry is the second moment about its estimate, so that
// [0, estimate + u95] is its 95 % interval where the estimate is 0.
void TruncateAmbient(double unbounded_ambient, double estimate, Matrix3& covariance) {
  const double variance = covariance(kAmbient, kAmbient);
  if (!(variance > 0.0)) return;
  const TruncatedNormal truncated = TruncateAtZero(unbounded_ambient, std::sqrt(variance));
  const Vector3 column = covariance.col(kAmbient);
  covariance +=
      column * column.transpose() * ((truncated.variance - variance) / (variance * variance));
  const double shift = truncated.mean - estimate;
  covariance(kAmbient, kAmbient) += shift * shift;
}

Vector3 ConsideredShift(const Matrix3& covariance, const Rows& jacobian,
                        const Eigen::VectorXd& whitened_influence) {
  return -covariance * (jacobian.transpose() * whitened_influence);
}

// Light cannot be negative: the marginal of E0 is cut at zero.
void CutAmbient(const UncertaintyInput& input, const Linearised& at, const Matrix3& covariance,
                Matrix3& total) {
  Vector3 gradient = at.jacobian.transpose() * at.residual;
  for (int k = 0; k < kParameters; ++k) {
    const ParameterRule& rule = input.estimation->rules[k];
    if (!rule.free || !(rule.prior_sd > 0.0)) continue;
    gradient[k] += (input.theta[k] - rule.prior_mean) / (rule.prior_sd * rule.prior_sd);
  }
  const double step = (covariance * gradient)[kAmbient];
  TruncateAmbient(input.theta[kAmbient] - step, input.theta[kAmbient], total);
}

// What the parameters held at their priors do to the free ones.
void AddHeldParameters(const Estimation& estimation, const Linearised& at,
                       const Matrix3& covariance, Matrix3& total) {
  for (int k = 0; k < kParameters; ++k) {
    const ParameterRule& rule = estimation.rules[k];
    if (rule.free || !(rule.prior_sd > 0.0)) continue;
    Vector3 shift = ConsideredShift(covariance, at.jacobian, at.jacobian.col(k) * rule.prior_sd);
    shift[k] = rule.prior_sd;
    total += shift * shift.transpose();
  }
}

void AddConsidered(const UncertaintyInput& input, const Linearised& at, const Matrix3& covariance,
                   Matrix3& total) {
  for (const Consider& influence : input.considered) {
    Eigen::VectorXd whitened(at.jacobian.rows());
    for (Eigen::Index i = 0; i < whitened.size(); ++i) {
      const ReadingRow& row = input.estimation->rows[i];
      const bool counts = row.form != ReadingRow::Form::kCensored && row.direct_gain > 0.0;
      const double unit = row.form == ReadingRow::Form::kLinear ? row.measured : 1.0;
      const double change = influence.relative * std::pow(row.distance, influence.distance_power);
      whitened[i] = counts ? unit * change / (row.sigma * input.row_scale) : 0.0;
    }
    const Vector3 shift = ConsideredShift(covariance, at.jacobian, whitened);
    total += shift * shift.transpose();
  }
}

// Each instrument's calibration changes all of its rows by one factor.
void AddCalibrations(const UncertaintyInput& input, const Linearised& at, const Matrix3& covariance,
                     Matrix3& total) {
  const std::vector<ReadingRow>& rows = input.estimation->rows;
  int instruments = 0;
  for (const ReadingRow& row : rows) instruments = std::max(instruments, row.instrument + 1);
  for (int k = 0; k < instruments; ++k) {
    Eigen::VectorXd whitened(at.jacobian.rows());
    for (Eigen::Index i = 0; i < whitened.size(); ++i) {
      const ReadingRow& row = rows[i];
      const double unit = row.form == ReadingRow::Form::kLinear ? row.measured : 1.0;
      whitened[i] =
          row.instrument == k ? row.calibration * unit / (row.sigma * input.row_scale) : 0.0;
    }
    const Vector3 shift = ConsideredShift(covariance, at.jacobian, whitened);
    total += shift * shift.transpose();
  }
}

bool Determines(const Matrix3& triangle) {
  for (int k = 0; k < kParameters; ++k) {
    if (!(std::abs(triangle(k, k)) > 1e-300) || !std::isfinite(triangle(k, k))) return false;
  }
  return true;
}

}  // namespace

Result<Covariance> EstimateCovariance(const UncertaintyInput& input) {
  const Estimation& estimation = *input.estimation;
  const Linearised at = Linearise(estimation, input.theta, input.row_scale);
  const Matrix3 r = TriangleOf(WithPriors(estimation, at.jacobian));
  if (!Determines(r)) {
    return Refused("underdetermined", "fit", "the readings do not determine every parameter");
  }
  const Matrix3 inverse = r.triangularView<Eigen::Upper>().solve(Matrix3::Identity());
  Matrix3 covariance = inverse * inverse.transpose();
  for (int k = 0; k < kParameters; ++k) {
    if (estimation.rules[k].free) continue;
    covariance.row(k).setZero();
    covariance.col(k).setZero();
  }
  Matrix3 total = covariance;
  if (estimation.rules[kAmbient].free) CutAmbient(input, at, covariance, total);
  AddHeldParameters(estimation, at, covariance, total);
  AddConsidered(input, at, covariance, total);
  AddCalibrations(input, at, covariance, total);
  Covariance out{};
  for (int i = 0; i < kParameters; ++i) {
    for (int j = 0; j < kParameters; ++j) {
      out[i * kParameters + j] = 0.5 * (total(i, j) + total(j, i));
    }
  }
  return out;
}

double ScaledCondition(const Estimation& estimation, const Theta& theta,
                       const std::array<bool, kParameters>& parameters) {
  const double infinite = std::numeric_limits<double>::infinity();
  Rows jacobian = Linearise(estimation, theta, 1.0).jacobian;
  std::array<int, kParameters> columns{};
  int p = 0;
  for (int k = 0; k < kParameters; ++k) {
    if (parameters[k]) columns[p++] = k;
  }
  if (jacobian.rows() < p) return infinite;
  for (const int k : columns) {
    const double length = jacobian.col(k).norm();
    if (!(length > 0.0) && parameters[k]) return infinite;
    if (length > 0.0) jacobian.col(k) /= length;
  }
  const Matrix3 r = TriangleOf(jacobian);
  Eigen::MatrixXd chosen(3, p);
  for (int j = 0; j < p; ++j) chosen.col(j) = r.col(columns[j]);
  const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(chosen).singularValues();
  const double least = singular[p - 1];
  return least > 1e-300 ? singular[0] / least : infinite;
}

std::optional<double> LeaveOneOut(const Estimation& estimation, const Theta& theta) {
  const Linearised at = Linearise(estimation, theta, 1.0);
  const Matrix3 r = TriangleOf(WithPriors(estimation, at.jacobian));
  if (!(r.diagonal().cwiseAbs().minCoeff() > 1e-300)) return std::nullopt;
  double sum = 0.0;
  int count = 0;
  for (Eigen::Index i = 0; i < at.jacobian.rows(); ++i) {
    const ReadingRow& row = estimation.rows[i];
    if (row.form != ReadingRow::Form::kLog) continue;
    Vector3 derivative = at.jacobian.row(i);
    for (int k = 0; k < kParameters; ++k) {
      if (!estimation.rules[k].free) derivative[k] = 0.0;
    }
    const Vector3 half = r.transpose().triangularView<Eigen::Lower>().solve(derivative);
    const double left = 1.0 - half.squaredNorm();
    if (!(left > 1e-9)) return std::nullopt;
    const double relative = std::expm1(at.residual[i] * row.sigma / left);
    sum += relative * relative;
    ++count;
  }
  if (count < 3 || !std::isfinite(sum)) return std::nullopt;
  return std::sqrt(sum / count);
}

double ChiSquared95(int dof) {
  const double spread = 2.0 / (9.0 * dof);
  const double root = 1.0 - spread + 1.6448536269514722 * std::sqrt(spread);
  return dof * root * root * root;
}

}  // namespace lightcal::fit
