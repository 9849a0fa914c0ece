// SPDX-License-Identifier: Apache-2.0
// How probable rows are, so that what a lamp may be can be weighed. A problem (least_squares.h) of
// `rows` that each have sigma, own_sigma and, of those that see walls, WallsOfRow.
// Internal to this room: needs Eigen and Ceres's header-only parts alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "lightcal/fit/model/least_squares.h"
#include "lightcal/fit/model/reading_model.h"

namespace lightcal::fit {

// ln of the rows' density, up to a constant. Those of one place have the covariance D + s s^T, D of
// what is their own and s the scatter they share: its inverse by Sherman and Morrison, its
// determinant |D| (1 + s^T D^-1 s).
template <class P>
[[nodiscard]] double LnDensity(const P& problem, const ValuesOf<P>& theta) {
  struct Shared {
    double strength = 0.0, pull = 0.0;  // s^T D^-1 s, s^T D^-1 (reading - model)
  };
  std::vector<Shared> places;
  double ln = 0.0;
  for (std::size_t i = 0; i < problem.rows.size(); ++i) {
    const auto& row = problem.rows[i];
    const double residual = ResidualAt(problem, i, theta.data());
    if (row.form == RowForm::kCensored) {  // a limit: what lies within it has its whole probability
      ln -= 0.5 * residual * residual;
      continue;
    }
    if (!row.walls || row.walls->rows == 1) {
      ln -= 0.5 * residual * residual + std::log(row.sigma);
      continue;
    }
    const double whole = row.sigma / row.own_sigma;
    const double own = residual * whole;
    ln -= 0.5 * own * own + std::log(row.own_sigma);
    const double scatter = std::sqrt(std::max(0.0, whole * whole - 1.0) / row.walls->rows);
    const auto at = static_cast<std::size_t>(row.walls->place);
    if (places.size() <= at) places.resize(at + 1);
    places[at].strength += scatter * scatter;
    places[at].pull += scatter * own;
  }
  for (const Shared& place : places) {
    ln += 0.5 * place.pull * place.pull / (1.0 + place.strength) - 0.5 * std::log1p(place.strength);
  }
  return ln;
}

// ln of the probability of the rows, up to a constant that all of a lamp's hypotheses share:
// Laplace's approximation about theta.
template <class P>
[[nodiscard]] double LnEvidenceOf(const P& problem, const ValuesOf<P>& theta) {
  double ln = LnDensity(problem, theta) - 0.5 * PriorChiSquaredOf(problem, theta);
  const auto r = FreeTriangle(problem, Linearise(problem, theta));
  for (int k = 0; k < P::kCount; ++k) {
    const ParameterRule& rule = problem.rules[k];
    if (!rule.free) continue;
    ln -= std::log(std::abs(r(k, k)));
    if (rule.prior_sd > 0.0) ln -= std::log(rule.prior_sd);
  }
  return std::isfinite(ln) ? ln : -std::numeric_limits<double>::max();
}

}  // namespace lightcal::fit
