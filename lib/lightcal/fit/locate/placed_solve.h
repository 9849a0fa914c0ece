// SPDX-License-Identifier: Apache-2.0
// Maximum a posteriori estimate of ln I, position, E0, d0, the walls' light and the lamp's gradient
// from placed readings, in any one set of units, and how well they determine it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/locate/placed_model.h"
#include "lightcal/fit/model/solve.h"
#include "lightcal/fit/model/uncertainty.h"

namespace lightcal::fit {

// A least-squares problem (least_squares.h) of readings whose places are known.
struct PlacedEstimation {
  std::vector<PlacedRow> rows;
  std::optional<Vec3> aim;  // unit, of a flat Lambertian source
  std::array<ParameterRule, kPlacedParameters> rules = {
      {{.free = true}, {.free = true}, {.free = true}, {.free = true}}};

  static constexpr int kCount = kPlacedParameters;
  [[nodiscard]] std::size_t RowCount() const { return rows.size(); }
  [[nodiscard]] Bounds BoundsOf(int k) const {
    return k == kPlacedAmbient ? Bounds{.low = 0.0} : Bounds{};
  }
  // Undefined (false) where meter or lamp faces away, and for logarithms of what is not above 0.
  template <class T>
  [[nodiscard]] bool Residual(std::size_t i, const T* theta, T* residual) const {
    T lux(0.0);
    const PlacedRow& row = rows[i];
    return PlacedIlluminance(row, aim, theta, &lux) &&
           WhitenedResidual(row.form, row.measured, row.sigma, lux, residual);
  }
};

using PlacedCovariance =
    std::array<double, static_cast<std::size_t>(kPlacedParameters) * kPlacedParameters>;

// Minimises 1/2 sum r_i^2 + priors from `start`, E0 >= 0: by TinySolver, where it comes to no end
// by Ceres in full, then by Gauss-Newton. Fails: no_convergence.
[[nodiscard]] Result<PlacedTheta> SolvePlaced(const PlacedEstimation& estimation,
                                              const PlacedTheta& start);

// Gives each row's sigma the scatter of the light from the walls, by their share at theta.
void SettleScatter(PlacedEstimation& estimation, const PlacedTheta& theta);

// Sum of squared residuals with the priors of free parameters; infinite where a row has none.
[[nodiscard]] double PlacedChiSquared(const PlacedEstimation& estimation, const PlacedTheta& theta);
// Of the rows one by one.
[[nodiscard]] std::vector<double> PlacedResiduals(const PlacedEstimation& estimation,
                                                  const PlacedTheta& theta);

// Covariance of the parameters at theta, those held having none: the inverse of J^T J of rows
// and priors, E0 cut at zero as by EstimateCovariance, `considered` influences carried through.
// `position_sd` > 0 adds that prior on each coordinate (for layouts that do not determine it).
// Fails: underdetermined.
struct PlacedUncertainty {
  double row_scale = 1.0;  // Birge ratio
  double position_sd = 0.0;
  std::vector<Consider> considered;
};
[[nodiscard]] Result<PlacedCovariance> EstimatePlacedCovariance(const PlacedEstimation& estimation,
                                                                const PlacedTheta& theta,
                                                                const PlacedUncertainty& input);

// Ratio of the largest to the smallest singular value of the rows' Jacobian over the free
// parameters, columns scaled to unit length, priors left out (those of offset, walls and gradient
// are kept: little else tells them). Infinite with fewer rows than parameters.
[[nodiscard]] double PlacedCondition(const PlacedEstimation& estimation, const PlacedTheta& theta);

}  // namespace lightcal::fit
