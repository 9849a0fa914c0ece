// SPDX-License-Identifier: Apache-2.0
// Covariance of an estimate, and how well the readings determine it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/model/solve.h"

namespace lightcal::fit {

using Covariance = std::array<double, std::size_t{kParameters} * kParameters>;
[[nodiscard]] inline double SdOf(const Covariance& covariance, Parameter k) {
  return std::sqrt(covariance[k * kParameters + k]);
}

// A systematic influence that is not fitted: one standard deviation of it changes every ln E by
// `relative` (the same sign in all rows, growing with distance to the power `distance_power`).
struct Consider {
  double relative = 0.0;
  double distance_power = 0.0;
  std::string name{};     // the effect it stands for
  bool own_lamp = false;  // a data sheet's rows have none of it
  // Light of other sources, the same everywhere: relative times the intensity, in lux. Distance
  // power 2; what a shadow card hides, or leaves, holds it too.
  bool constant = false;
  bool of_pictures = false;  // what a meter read has none of it
  // Of one instrument's cosine: relative times 1 - cos(tilt) in its rows. Placed rows alone have
  // it.
  std::optional<int> slant_of{};
};

// 1 sigma of what the influence does to ln E of a row, the lamp's intensity being what it is.
[[nodiscard]] inline double InfluenceOn(const ReadingRow& row, const Consider& influence,
                                        double intensity) {
  const bool spared =
      (influence.own_lamp && row.data_sheet) || (influence.of_pictures && !row.picture);
  if (row.form == RowForm::kCensored || spared) return 0.0;
  if (influence.constant) {
    return row.ambient_gain > 0.0 && row.measured > 0.0
               ? influence.relative * intensity / row.measured
               : 0.0;
  }
  if (!(row.direct_gain > 0.0)) return 0.0;
  return influence.relative * std::pow(row.distance, influence.distance_power);
}

struct UncertaintyInput {
  const Estimation* estimation = nullptr;
  Theta theta{};
  double row_scale = 1.0;  // every row's sigma is multiplied by it (Birge ratio)
  std::vector<Consider> considered;
};

// Covariance of (ln I, d0, E0) at theta: the inverse of J^T J of the whitened rows and of the
// priors of the free parameters, by QR (weights may span 1e12), plus, for each parameter that is
// held though uncertain (prior_sd > 0) and each considered influence, its standard deviation
// carried through the estimate (Schmidt's consider covariance); so is each instrument's
// calibration, a factor its rows have in common and more of them do not average away (JCGM 100,
// F.1.2.3). A free E0 is bounded below by 0: its marginal becomes the normal truncated there, and
// the others follow by their regression on it. Fails: underdetermined (a free parameter no row and
// no prior determines).
[[nodiscard]] Result<Covariance> EstimateCovariance(const UncertaintyInput& input);

// What each considered influence alone adds to the variance of ln I there, in their order. Empty
// where EstimateCovariance fails.
[[nodiscard]] std::vector<double> ConsideredVariances(const UncertaintyInput& input);

// Ratio of the largest to the smallest singular value of the whitened rows' Jacobian over the
// parameters marked true, columns scaled to unit length; priors are left out. Infinite when a
// column is zero or fewer rows than parameters are there.
[[nodiscard]] double ScaledCondition(const Estimation& estimation, const Theta& theta,
                                     const std::array<bool, kParameters>& parameters);

// Root mean square relative error of predicting each log row from all others, by the hat matrix of
// the linearised problem: ln error_i = r_i sigma_i/(1 - h_i), relative = exp(..) - 1. Absent when
// some row decides a parameter alone or when there are fewer than three log rows.
[[nodiscard]] std::optional<double> LeaveOneOut(const Estimation& estimation, const Theta& theta);

// The 95th percentile of chi-squared with `dof` degrees of freedom (Wilson and Hilferty 1931,
// within 1.5 % for dof >= 1).
[[nodiscard]] double ChiSquared95(int dof);

}  // namespace lightcal::fit
