// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/placed_solve.h"

#include <cmath>
#include <optional>

#include "lightcal/fit/model/least_squares.h"

namespace lightcal::fit {
namespace {

using PlacedMatrix = SquareOf<PlacedEstimation>;
using PlacedVector = VectorOf<PlacedEstimation>;
using At = Linearised<PlacedEstimation>;

// A free E0 cannot be negative: its marginal becomes the normal truncated at zero, the others
// follow by their regression on it, and how far that moves the mean from the estimate counts as
// error.
void CutAmbient(const At& at, double estimate, const PlacedMatrix& covariance,
                PlacedMatrix& total) {
  const double variance = covariance(kPlacedAmbient, kPlacedAmbient);
  if (!(variance > 0.0)) return;
  const TruncatedNormal truncated =
      CutAtZero<PlacedEstimation>(at, covariance, kPlacedAmbient, estimate);
  const PlacedVector regression = covariance.col(kPlacedAmbient) / variance;
  const double shift = truncated.mean - estimate;
  total += regression * regression.transpose() * (truncated.variance - variance + shift * shift);
}

// The optimum by TinySolver, which knows no bounds, with no less ambient light than none.
std::optional<PlacedTheta> SolveSmall(const PlacedEstimation& estimation,
                                      const PlacedTheta& start) {
  const auto theta = SolveNotBelowZero(
      estimation, kPlacedAmbient, start,
      [&](const PlacedTheta& from, const auto& held) { return SolveTiny(estimation, from, held); });
  return theta ? std::optional(Polish(estimation, *theta)) : std::nullopt;
}

// 1 sigma of what the influence does to ln E of a row.
double InfluenceOn(const PlacedRow& row, const PlacedTheta& theta, const Consider& influence) {
  if (influence.slant_of) {
    if (row.instrument != *influence.slant_of) return 0.0;
    return influence.relative * (1.0 - TiltCosineOf(row, theta.data()));
  }
  return influence.relative * std::pow(DistanceOf(row, theta.data()), influence.distance_power);
}

void AddConsidered(const PlacedEstimation& estimation, const PlacedTheta& theta,
                   const PlacedUncertainty& input, const At& at, const PlacedMatrix& covariance,
                   PlacedMatrix& total) {
  for (const Consider& influence : input.considered) {
    Eigen::VectorXd whitened = Eigen::VectorXd::Zero(at.residual.size());
    for (std::size_t i = 0; i < estimation.rows.size(); ++i) {
      const PlacedRow& row = estimation.rows[i];
      if (row.form != RowForm::kLog || !(row.direct_gain > 0.0)) continue;
      whitened[static_cast<Eigen::Index>(i)] =
          InfluenceOn(row, theta, influence) / (row.sigma * input.row_scale);
    }
    const PlacedVector shift = Carried<PlacedEstimation>(at, covariance, whitened);
    total += shift * shift.transpose();
  }
}

}  // namespace

Result<PlacedTheta> SolvePlaced(const PlacedEstimation& estimation, const PlacedTheta& start) {
  if (const auto theta = SolveSmall(estimation, start)) return *theta;
  return SolveInFullBy(estimation, start, {.iterations = 100}, "position");
}

void SettleScatter(PlacedEstimation& estimation, const PlacedTheta& theta) {
  for (PlacedRow& row : estimation.rows) {
    if (!row.walls) continue;
    double whole = 1.0;
    const bool seen = PlacedIlluminance(row, estimation.aim, theta.data(), &whole);
    if (row.form == RowForm::kLinear) whole = 1.0;
    const double walls = std::exp(theta[kPlacedLnIntensity]) *
                         WallsPerCandela(row, DistanceOf(row, theta.data()), theta.data());
    const double scatter = row.walls->scatter * walls / whole;
    row.sigma = seen && whole > 0.0 ? std::hypot(row.own_sigma, scatter) : row.own_sigma;
  }
}

std::vector<double> PlacedResiduals(const PlacedEstimation& estimation, const PlacedTheta& theta) {
  std::vector<double> out;
  for (std::size_t i = 0; i < estimation.rows.size(); ++i) {
    out.push_back(ResidualAt(estimation, i, theta.data()));
  }
  return out;
}

double PlacedChiSquared(const PlacedEstimation& estimation, const PlacedTheta& theta) {
  return 2.0 * HalfChiSquaredOf(estimation, theta);
}

Result<PlacedCovariance> EstimatePlacedCovariance(const PlacedEstimation& estimation,
                                                  const PlacedTheta& theta,
                                                  const PlacedUncertainty& input) {
  PlacedEstimation placed = estimation;
  for (int k = kPlacedX; input.position_sd > 0.0 && k <= kPlacedZ; ++k) {
    placed.rules[k] = {true, theta[k], input.position_sd};
  }
  const At at = Linearise(placed, theta, input.row_scale);
  const std::optional<PlacedMatrix> covariance = CovarianceAt(placed, at);
  if (!covariance) {
    return Refused("underdetermined", "fit", "the readings do not determine the lamp's position");
  }
  PlacedMatrix total = *covariance;
  if (placed.rules[kPlacedAmbient].free) {
    CutAmbient(at, theta[kPlacedAmbient], *covariance, total);
  }
  AddConsidered(placed, theta, input, at, *covariance, total);
  return Symmetric<PlacedEstimation>(total);
}

double PlacedCondition(const PlacedEstimation& estimation, const PlacedTheta& theta) {
  At at = Linearise(estimation, theta);
  at.jacobian.row(at.jacobian.rows() - kPlacedParameters + kPlacedAmbient).setZero();
  std::vector<int> columns;
  for (int k = 0; k < kPlacedParameters; ++k) {
    if (estimation.rules[k].free) columns.push_back(k);
  }
  const double condition = ConditionOf<kPlacedParameters>(at.jacobian, columns);
  return std::isfinite(condition) ? condition : std::numeric_limits<double>::infinity();
}

}  // namespace lightcal::fit
