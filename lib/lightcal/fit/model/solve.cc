// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/solve.h"

#include <ceres/jet.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lightcal/fit/model/least_squares.h"

namespace lightcal::fit {
namespace {

// A problem of one row, to differentiate it.
struct RowProblem {
  static constexpr int kCount = kParameters;
  const ReadingRow& row;
  template <class T>
  [[nodiscard]] bool Residual(std::size_t /*i*/, const T* theta, T* residual) const {
    return RowResidual(row, theta, residual);
  }
  [[nodiscard]] bool Differentiate(std::size_t /*i*/, const double* theta, double* residual,
                                   double* gradient) const {
    return RowResidual<kCount>(row, theta, residual, gradient);
  }
};

// The estimation where no instrument's scale and no aim is free: most are, and quicker so.
struct OfOneScale {
  const Estimation& whole;
  std::array<ParameterRule, kWithoutScale> rules;

  static constexpr int kCount = kWithoutScale;
  [[nodiscard]] std::size_t RowCount() const { return whole.RowCount(); }
  [[nodiscard]] Bounds BoundsOf(int k) const { return whole.BoundsOf(k); }
  template <class T>
  [[nodiscard]] bool Residual(std::size_t i, const T* theta, T* residual) const {
    return RowResidual(whole.rows[i], theta, residual);
  }
  [[nodiscard]] bool Differentiate(std::size_t i, const double* theta, double* residual,
                                   double* gradient) const {
    return RowResidual<kCount>(whole.rows[i], theta, residual, gradient);
  }
  [[nodiscard]] bool Bend(std::size_t i, const double* theta, double* residual, double* gradient,
                          double* bend) const {
    return RowResidual<kCount>(whole.rows[i], theta, residual, gradient, bend);
  }
};

OfOneScale Smaller(const Estimation& estimation) {
  OfOneScale out{estimation, {}};
  std::copy_n(estimation.rules.begin(), kWithoutScale, out.rules.begin());
  return out;
}

ValuesOf<OfOneScale> Smaller(const Theta& theta) {
  ValuesOf<OfOneScale> out;
  std::copy_n(theta.begin(), kWithoutScale, out.begin());
  return out;
}

Theta Whole(const ValuesOf<OfOneScale>& values) {
  Theta out{};
  std::ranges::copy(values, out.begin());
  return out;
}

// Illuminance per candela of the lamp alone by the distance offset. Off the axis by automatic
// differentiation, its second derivative by differences of the first: Newton's steps need no more.
AxialFalloff DirectAt(const ReadingRow& row, double offset) {
  if (!(row.direct_gain > 0.0)) return {.value = row.bounce};
  if (!row.off_axis) {
    const AxialFalloff axial = AxialFalloffAt(row.shape, row.distance + offset);
    return {row.direct_gain * axial.value + row.bounce, row.direct_gain * axial.slope,
            row.direct_gain * axial.bend};
  }
  using Jet = ceres::Jet<double, 1>;
  constexpr double kPartOfDistance = 1e-6;
  const double more = offset + kPartOfDistance * row.distance;
  const Jet at = LuxPerCandela(row, Jet(offset, 0));
  const Jet beyond = LuxPerCandela(row, Jet(more, 0));
  return {at.a, at.v[0], (beyond.v[0] - at.v[0]) / (more - offset)};
}

// With E0 at its bound where it would be below; no offset at one.
template <class P>
std::optional<ValuesOf<P>> SolveWithin(const P& problem, const ValuesOf<P>& start,
                                       double last_step) {
  return SolveNotBelowZero(problem, kAmbient, start,
                           [&](const ValuesOf<P>& from, const std::array<bool, P::kCount>& held) {
                             auto theta = SolveNear(problem, from, held, last_step);
                             if (theta && AtBound(problem, *theta, kDistanceOffset)) theta.reset();
                             return theta;
                           });
}

}  // namespace

std::optional<Theta> SolveCoarsely(const Estimation& estimation, const Theta& start,
                                   double last_step) {
  const auto& rules = estimation.rules;
  if (rules[kLnScale].free || rules[kAimX].free || rules[kAimY].free)
    return SolveWithin(estimation, start, last_step);
  const auto values = SolveWithin(Smaller(estimation), Smaller(start), last_step);
  return values ? std::optional(Whole(*values)) : std::nullopt;
}

std::optional<Theta> SolveQuickly(const Estimation& estimation, const Theta& start) {
  return SolveCoarsely(estimation, start, kLastStep);
}

Result<Theta> Solve(const Estimation& estimation, const Theta& start, Loss loss, double scale) {
  const SolverChoice solver = estimation.choice.solver;
  if (solver == SolverChoice::kClosedForm) return start;
  if (loss == Loss::kSquared && solver == SolverChoice::kQuick) {
    if (const std::optional<Theta> theta = SolveQuickly(estimation, start)) return *theta;
  }
  return SolveInFull(estimation, start, loss, scale);
}

Result<Theta> SolveNearly(const Estimation& estimation, const Theta& start) {
  constexpr double kNearly = 0.3;
  if (estimation.choice.solver != SolverChoice::kClosedForm) {
    if (const std::optional<Theta> theta = SolveCoarsely(estimation, start, kNearly)) {
      return *theta;
    }
  }
  return Solve(estimation, start);
}

Result<Theta> SolveInFull(const Estimation& estimation, const Theta& start, Loss loss,
                          double scale) {
  FullSolver how{.loss = loss, .scale = scale, .first_trust_region = 1e8};
  if (loss != Loss::kSquared) {
    how.function_tolerance = 1e-9;
    how.parameter_tolerance = 1e-7;
    how.polish = false;
  }
  if (estimation.choice.solver == SolverChoice::kLoose) {
    how.function_tolerance = 1e-3;
    how.parameter_tolerance = 1e-4;
    how.polish = false;
  }
  return SolveInFullBy(estimation, start, how, "estimate");
}

// The chain rule written out.
template <int N>
bool RowResidual(const ReadingRow& row, const double* theta, double* residual, double* gradient,
                 double* bend) {
  AxialFalloff direct = DirectAt(row, theta[kDistanceOffset]);
  const AxialFalloff stated = {direct.value - row.bounce, direct.slope, direct.bend};
  PartByAim by_aim;
  if constexpr (N > kAimY) {
    if (row.by_aim) by_aim = PartByAimAt(row, theta[kAimX], theta[kAimY]);
    direct = {row.bounce + stated.value * by_aim.value, stated.slope * by_aim.value,
              stated.bend * by_aim.value};
  }
  const double walls = WallsPerCandela(row, theta);
  double scale = 1.0;
  if constexpr (N > kLnScale) scale = ScaleOfRow(row, theta);
  const double intensity = scale * std::exp(theta[kLnIntensity]);
  const double ambient_gain = scale * row.ambient_gain;
  const double lamp = intensity * (direct.value + walls);
  const double predicted = lamp + ambient_gain * theta[kAmbient];
  if (!WhitenedResidual(row.form, row.measured, row.sigma, predicted, residual)) return false;
  const bool silent = row.form == RowForm::kCensored && !(*residual > 0.0);
  const double by_illuminance =
      silent ? 0.0 : -1.0 / (row.form == RowForm::kLinear ? row.sigma : row.sigma * predicted);
  gradient[kLnIntensity] = by_illuminance * lamp;
  gradient[kDistanceOffset] = by_illuminance * intensity * direct.slope;
  gradient[kAmbient] = by_illuminance * ambient_gain;
  gradient[kLnWalls] = by_illuminance * intensity * walls;
  gradient[kWallsSlope] = row.walls ? gradient[kLnWalls] * row.walls->x : 0.0;
  if constexpr (N > kLnScale) gradient[kLnScale] = row.scale * by_illuminance * predicted;
  if constexpr (N > kAimY) {
    for (int i = 0; i < 2; ++i) {
      gradient[kAimX + i] = by_illuminance * intensity * stated.value * by_aim.slope[i];
    }
  }
  if (bend == nullptr) return true;
  // Of ln E: -dE_i dE_j/E^2 + d2E_ij/E; of E the second alone, whose entries repeat the first ones.
  const Eigen::Map<const Eigen::Matrix<double, N, 1>> g(gradient);
  Eigen::Map<Eigen::Matrix<double, N, N>> second(bend);
  const double of_squares = silent || row.form == RowForm::kLinear ? 0.0 : row.sigma;
  for (int a = 0; a < N; ++a) {
    const double slope = of_squares * g[a];
    for (int b = a; b < N; ++b) second(b, a) = slope * g[b];
  }
  if (silent) return true;
  second(kLnIntensity, kLnIntensity) += g[kLnIntensity];
  second(kDistanceOffset, kLnIntensity) += g[kDistanceOffset];
  second(kDistanceOffset, kDistanceOffset) += by_illuminance * intensity * direct.bend;
  if constexpr (N > kLnScale) second.row(kLnScale) += row.scale * g.transpose();
  if constexpr (N > kAimY) {
    const double by_lamp = by_illuminance * intensity;
    for (int i = 0; i < 2; ++i) {
      second(kAimX + i, kLnIntensity) += g[kAimX + i];
      second(kAimX + i, kDistanceOffset) += by_lamp * stated.slope * by_aim.slope[i];
      second(kAimX + i, kLnScale) += row.scale * g[kAimX + i];
      second(kAimX + i, kAimX + i) += by_lamp * stated.value * by_aim.bend[i];
    }
    second(kAimY, kAimX) += by_lamp * stated.value * by_aim.bend[2];
  }
  if (!row.walls) return true;
  second(kLnWalls, kLnIntensity) += g[kLnWalls];
  second(kLnWalls, kLnWalls) += g[kLnWalls];
  second(kWallsSlope, kLnIntensity) += g[kWallsSlope];
  second(kWallsSlope, kLnWalls) += g[kWallsSlope];
  second(kWallsSlope, kWallsSlope) += g[kWallsSlope] * row.walls->x;
  return true;
}

template bool RowResidual<kParameters>(const ReadingRow&, const double*, double*, double*, double*);
template bool RowResidual<kWithoutScale>(const ReadingRow&, const double*, double*, double*,
                                         double*);

double RowResidual(const ReadingRow& row, const Theta& theta) {
  return ResidualAt(RowProblem{row}, 0, theta.data());
}

RowDerivative DifferentiateRow(const ReadingRow& row, const Theta& theta) {
  RowDerivative out;
  out.residual = DifferentiateAt(RowProblem{row}, 0, theta.data(), out.gradient.data());
  return out;
}

double HalfChiSquared(const Estimation& estimation, const Theta& theta) {
  return HalfChiSquaredOf(estimation, theta);
}

}  // namespace lightcal::fit
