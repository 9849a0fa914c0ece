// SPDX-License-Identifier: Apache-2.0
// Maximum a posteriori estimate of (ln I, d0, E0) from rows already in the solver's own units.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/model/parameter.h"
#include "lightcal/fit/model/reading_model.h"
#include "lightcal/records/accuracy_profile.h"

namespace lightcal::fit {

using Theta = std::array<double, kParameters>;

// A least-squares problem (least_squares.h) of readings whose distances are known.
struct Estimation {
  std::vector<ReadingRow> rows;
  std::array<ParameterRule, kParameters> rules;
  std::string_view uneven_part = "uneven_light";  // what the rows' unevenness is called
  double least_distance_offset = -1e300;          // d0 stays at or above it, so that d + d0 > 0
  EstimatorChoice choice{};

  static constexpr int kCount = kParameters;
  [[nodiscard]] std::size_t RowCount() const { return rows.size(); }
  [[nodiscard]] Bounds BoundsOf(int k) const {
    if (k == kDistanceOffset) return {.low = least_distance_offset};
    return k == kAmbient ? Bounds{.low = 0.0} : Bounds{};
  }
  template <class T>
  [[nodiscard]] bool Residual(std::size_t i, const T* theta, T* residual) const {
    return RowResidual(rows[i], theta, residual);
  }
  [[nodiscard]] bool Differentiate(std::size_t i, const double* theta, double* residual,
                                   double* gradient) const {
    return RowResidual<kCount>(rows[i], theta, residual, gradient);
  }
  [[nodiscard]] bool Bend(std::size_t i, const double* theta, double* residual, double* gradient,
                          double* bend) const {
    return RowResidual<kCount>(rows[i], theta, residual, gradient, bend);
  }
};

// Minimises 1/2 sum rho(r_i^2) + priors with Ceres from `start`, d0 and E0 in their boxes. `scale`
// widens the loss (a multiple of sigma). Fails: no_convergence.
// As estimation.choice.solver says: squared losses try SolveQuickly first by default.
[[nodiscard]] Result<Theta> Solve(const Estimation& estimation, const Theta& start,
                                  Loss loss = Loss::kSquared, double scale = 1.0);
// The same to about a tenth of a standard deviation, from where Solve takes the last digits.
[[nodiscard]] Result<Theta> SolveNearly(const Estimation& estimation, const Theta& start);
// The same always by the full solver.
[[nodiscard]] Result<Theta> SolveInFull(const Estimation& estimation, const Theta& start,
                                        Loss loss = Loss::kSquared, double scale = 1.0);
// The squared-loss optimum by Newton's steps or ceres::TinySolver, a tenth of the full solver's
// time and the same to 1e-9; E0 at its bound is held there. Absent where it does not converge or d0
// leaves its box.
[[nodiscard]] std::optional<Theta> SolveQuickly(const Estimation& estimation, const Theta& start);

// The same to about the square of its last step (standard deviations of a parameter, were it
// alone), for samples.
[[nodiscard]] std::optional<Theta> SolveCoarsely(const Estimation& estimation, const Theta& start,
                                                 double last_step);

// Whitened residual of one row at theta.
[[nodiscard]] double RowResidual(const ReadingRow& row, const Theta& theta);
// Whitened residual and its derivatives by (ln I, d0, E0).
struct RowDerivative {
  double residual = 0.0;
  std::array<double, kParameters> gradient{};
};
[[nodiscard]] RowDerivative DifferentiateRow(const ReadingRow& row, const Theta& theta);

// 1/2 sum r_i^2 with the priors of free parameters.
[[nodiscard]] double HalfChiSquared(const Estimation& estimation, const Theta& theta);

}  // namespace lightcal::fit
