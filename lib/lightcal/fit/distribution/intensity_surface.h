// SPDX-License-Identifier: Apache-2.0
// A non-negative smooth surface through samples of intensity, on a flat chart of directions.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal::fit {

// A direction at the angle gamma from the lamp's axis and the azimuth C lies at
//   u = gamma cos C,  v = gamma sin C   [rad]
// (azimuthal equidistant): the axis is a point like any other, and no azimuth is special.
struct ChartSample {
  double u = 0.0, v = 0.0;
  double value = 0.0;
  double weight = 0.0;  // 1 / sigma^2; 0 = not used
};

// Uniform cubic B-splines over a rectangle of the chart.
struct ChartGrid {
  double u0 = 0.0, v0 = 0.0;  // lower left corner
  double spacing = 0.1;       // of the knots, both ways
  int columns = 4, rows = 4;  // coefficients: intervals + 3

  [[nodiscard]] int Size() const { return columns * rows; }
  // The sixteen coefficients that make the value at (u, v), and their factors. Outside the
  // rectangle: those of its nearest point.
  struct Support {
    std::array<int, 16> index{};
    std::array<double, 16> factor{};
  };
  [[nodiscard]] Support At(double u, double v) const;
};

// Least squares of the samples with a penalty on second differences of the coefficients:
//   sum w (S - value)^2 + lambda t |D x|^2,   t = trace of the data's normal matrix / that of D'D
class SurfaceProblem {
 public:
  SurfaceProblem(const ChartGrid& grid, std::span<const ChartSample> samples);
  ~SurfaceProblem();
  SurfaceProblem(SurfaceProblem&&) noexcept;
  SurfaceProblem& operator=(SurfaceProblem&&) noexcept;

  // Generalised cross validation of the fit without bounds: N RSS/(N - trace of hat matrix)^2.
  [[nodiscard]] double CrossValidation(double lambda) const;
  // Coefficients, none negative: Ceres within bounds, then exactly on the coefficients left free.
  // Failed: no_convergence.
  [[nodiscard]] Result<std::vector<double>> SolveNonNegative(double lambda) const;
  // The same with these coefficients held at zero and the others free: how the solution moves when
  // the samples do.
  [[nodiscard]] std::vector<double> SolveWithZeros(double lambda,
                                                   std::span<const double> zeros_of) const;
  // Variance of the linear functional g'x of the solution, by the samples' noise.
  [[nodiscard]] double Variance(double lambda, std::span<const double> zeros_of,
                                std::span<const double> functional) const;
  // sum of w (S - value)^2 over the degrees of freedom N - trace.
  [[nodiscard]] double ReducedChi2(double lambda, std::span<const double> coefficients) const;

 private:
  struct Matrices;
  std::unique_ptr<Matrices> m_;
};

}  // namespace lightcal::fit
