// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/uncertainty.h"

#include <algorithm>
#include <cmath>

#include "lightcal/fit/model/least_squares.h"

namespace lightcal::fit {
namespace {

using Matrix3 = SquareOf<Estimation>;
using Vector3 = VectorOf<Estimation>;
using At = Linearised<Estimation>;

// Light cannot be negative: the normal marginal of E0 is cut at 0 and the change carried to the
// others by their regression on E0. E0's own entry is the second moment about its estimate, so that
// [0, estimate + u95] is its 95 % interval where the estimate is 0.
void CutAmbient(const UncertaintyInput& input, const At& at, const Matrix3& covariance,
                Matrix3& total) {
  const double variance = covariance(kAmbient, kAmbient);
  if (!(variance > 0.0)) return;
  const double estimate = input.theta[kAmbient];
  const TruncatedNormal truncated = CutAtZero<Estimation>(at, covariance, kAmbient, estimate);
  const Vector3 column = covariance.col(kAmbient);
  total += column * column.transpose() * ((truncated.variance - variance) / (variance * variance));
  const double shift = truncated.mean - estimate;
  total(kAmbient, kAmbient) += shift * shift;
}

// What the parameters held at their priors do to the free ones.
void AddHeldParameters(const Estimation& estimation, const At& at, const Matrix3& covariance,
                       Matrix3& total) {
  for (int k = 0; k < kParameters; ++k) {
    const ParameterRule& rule = estimation.rules[k];
    if (rule.free || !(rule.prior_sd > 0.0)) continue;
    Vector3 shift = Carried<Estimation>(at, covariance, at.jacobian.col(k) * rule.prior_sd);
    shift[k] = rule.prior_sd;
    total += shift * shift.transpose();
  }
}

// How far an influence that changes the reading of row i by `relative(row)`, all rows alike, moves
// the estimate (Schmidt's consider covariance).
template <class Relative>
Vector3 ShiftBy(const UncertaintyInput& input, const At& at, const Matrix3& covariance,
                const Relative& relative) {
  Vector3 gradient = Vector3::Zero();
  for (std::size_t i = 0; i < input.estimation->rows.size(); ++i) {
    const ReadingRow& row = input.estimation->rows[i];
    const double changed = relative(row);
    if (changed == 0.0) continue;
    const double unit = row.form == ReadingRow::Form::kLinear ? row.measured : 1.0;
    gradient += at.jacobian.row(static_cast<Eigen::Index>(i)).transpose() *
                (changed * unit / (row.sigma * input.row_scale));
  }
  return -covariance * gradient;
}

Vector3 ShiftByConsidered(const UncertaintyInput& input, const At& at, const Matrix3& covariance,
                          const Consider& influence) {
  const double intensity = std::exp(input.theta[kLnIntensity]);
  return ShiftBy(input, at, covariance,
                 [&](const ReadingRow& row) { return InfluenceOn(row, influence, intensity); });
}

// Each instrument's calibration changes all of its rows by one factor.
void AddCalibrations(const UncertaintyInput& input, const At& at, const Matrix3& covariance,
                     Matrix3& total) {
  int instruments = 0;
  for (const ReadingRow& row : input.estimation->rows) {
    instruments = std::max(instruments, row.instrument + 1);
  }
  for (int k = 0; k < instruments; ++k) {
    const Vector3 shift = ShiftBy(input, at, covariance, [k](const ReadingRow& row) {
      return row.instrument == k ? row.calibration : 0.0;
    });
    total += shift * shift.transpose();
  }
}

}  // namespace

Result<Covariance> EstimateCovariance(const UncertaintyInput& input) {
  const Estimation& estimation = *input.estimation;
  const At at = Linearise(estimation, input.theta, input.row_scale);
  const std::optional<Matrix3> covariance = CovarianceAt(estimation, at);
  if (!covariance) {
    return Refused("underdetermined", "fit", "the readings do not determine every parameter");
  }
  Matrix3 total = *covariance;
  if (estimation.rules[kAmbient].free) CutAmbient(input, at, *covariance, total);
  AddHeldParameters(estimation, at, *covariance, total);
  for (const Consider& influence : input.considered) {
    const Vector3 shift = ShiftByConsidered(input, at, *covariance, influence);
    total += shift * shift.transpose();
  }
  AddCalibrations(input, at, *covariance, total);
  return Symmetric<Estimation>(total);
}

std::vector<double> ConsideredVariances(const UncertaintyInput& input) {
  const At at = Linearise(*input.estimation, input.theta, input.row_scale);
  const std::optional<Matrix3> covariance = CovarianceAt(*input.estimation, at);
  if (!covariance) return {};
  std::vector<double> out;
  for (const Consider& influence : input.considered) {
    const double shift = ShiftByConsidered(input, at, *covariance, influence)[kLnIntensity];
    out.push_back(shift * shift);
  }
  return out;
}

double ScaledCondition(const Estimation& estimation, const Theta& theta,
                       const std::array<bool, kParameters>& parameters) {
  std::vector<int> columns;
  for (int k = 0; k < kParameters; ++k) {
    if (parameters[k]) columns.push_back(k);
  }
  const At at = Linearise(estimation, theta);
  return ConditionOf<kParameters>(
      at.jacobian.topRows(static_cast<Eigen::Index>(estimation.rows.size())), columns);
}

std::optional<double> LeaveOneOut(const Estimation& estimation, const Theta& theta) {
  const At at = Linearise(estimation, theta);
  const Matrix3 r = FreeTriangle(estimation, at);
  if (!(r.diagonal().cwiseAbs().minCoeff() > 1e-300)) return std::nullopt;
  double sum = 0.0;
  int count = 0;
  for (std::size_t n = 0; n < estimation.rows.size(); ++n) {
    const ReadingRow& row = estimation.rows[n];
    const auto i = static_cast<Eigen::Index>(n);
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
