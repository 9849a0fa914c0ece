// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/solve.h"

#include "lightcal/fit/model/least_squares.h"

namespace lightcal::fit {
namespace {

// A problem of one row, to differentiate it.
struct OneRow {
  static constexpr int kCount = kParameters;
  const ReadingRow& row;
  template <class T>
  [[nodiscard]] bool Residual(std::size_t /*i*/, const T* theta, T* residual) const {
    return RowResidual(row, theta, residual);
  }
};

}  // namespace

std::optional<Theta> SolveCoarsely(const Estimation& estimation, const Theta& start) {
  std::optional<Theta> theta = SolveTiny(estimation, start);
  if (!theta || AtBound(estimation, *theta, kDistanceOffset)) return std::nullopt;
  if (!estimation.rules[kAmbient].free || (*theta)[kAmbient] >= 0.0) return theta;
  (*theta)[kAmbient] = 0.0;
  theta = SolveTiny(estimation, *theta, {false, false, true});
  if (!theta || AtBound(estimation, *theta, kDistanceOffset)) return std::nullopt;
  if (NormalEquationsAt(estimation, *theta).gradient[kAmbient] < 0.0) return std::nullopt;
  return theta;
}

std::optional<Theta> SolveQuickly(const Estimation& estimation, const Theta& start) {
  const std::optional<Theta> theta = SolveCoarsely(estimation, start);
  if (!theta) return std::nullopt;
  return Polish(estimation, *theta);
}

Result<Theta> Solve(const Estimation& estimation, const Theta& start, Loss loss, double scale) {
  const SolverChoice solver = estimation.choice.solver;
  if (solver == SolverChoice::kClosedForm) return start;
  if (loss == Loss::kSquared && solver == SolverChoice::kQuick) {
    if (const std::optional<Theta> theta = SolveQuickly(estimation, start)) return *theta;
  }
  return SolveInFull(estimation, start, loss, scale);
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

double RowResidual(const ReadingRow& row, const Theta& theta) {
  return ResidualAt(OneRow{row}, 0, theta.data());
}

RowDerivative DifferentiateRow(const ReadingRow& row, const Theta& theta) {
  RowDerivative out;
  out.residual = DifferentiateAt(OneRow{row}, 0, theta.data(), out.gradient.data());
  return out;
}

double HalfChiSquared(const Estimation& estimation, const Theta& theta) {
  return HalfChiSquaredOf(estimation, theta);
}

}  // namespace lightcal::fit
