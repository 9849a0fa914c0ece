// SPDX-License-Identifier: Apache-2.0
// The least-squares problem that every solver of the page gets: three parameters, six readings, two
// priors.
//   r_i = (ln m_i - ln(exp(ln I)/(d_i + d0)^2 + E0))/sigma,   d0/sd_d0,   E0/sd_E0
// Includes no header of lightcal.
#pragma once

#include <array>
#include <cmath>

#include "rows.h"

namespace page {

inline constexpr int kReadings = 6, kUnknowns = 3, kResiduals = kReadings + 2;

struct SolverProblem {
  std::array<double, kReadings> distance{}, measured{};
  double sigma = 1.0, offset_sd = 1.0, ambient_sd = 1.0;
  double start_ln_intensity = 0.0;
};

inline SolverProblem SolverProblemOf(const Numbers& row) {
  SolverProblem problem;
  for (int i = 0; i < kReadings; ++i) {
    problem.distance[i] = row[2 * i];
    problem.measured[i] = row[2 * i + 1];
  }
  problem.sigma = row[12];
  problem.offset_sd = row[13];
  problem.ambient_sd = row[14];
  problem.start_ln_intensity = row[15];
  return problem;
}

// residuals: kResiduals long. jacobian(i, k) is called for every entry that is not zero, or not at
// all where `with_jacobian` is false.
template <class Jacobian>
void Evaluate(const SolverProblem& problem, const double* theta, double* residuals,
              bool with_jacobian, const Jacobian& jacobian) {
  const double intensity = std::exp(theta[0]);
  for (int i = 0; i < kReadings; ++i) {
    const double r = problem.distance[i] + theta[1];
    const double direct = intensity / (r * r);
    const double lux = direct + theta[2];
    residuals[i] = (std::log(problem.measured[i]) - std::log(lux)) / problem.sigma;
    if (!with_jacobian) continue;
    const double each = -1.0 / (lux * problem.sigma);
    jacobian(i, 0, each * direct);
    jacobian(i, 1, each * direct * -2.0 / r);
    jacobian(i, 2, each);
  }
  residuals[kReadings] = theta[1] / problem.offset_sd;
  residuals[kReadings + 1] = theta[2] / problem.ambient_sd;
  if (!with_jacobian) return;
  jacobian(kReadings, 1, 1.0 / problem.offset_sd);
  jacobian(kReadings + 1, 2, 1.0 / problem.ambient_sd);
}

}  // namespace page
