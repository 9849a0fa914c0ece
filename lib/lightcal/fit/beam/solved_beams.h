// SPDX-License-Identifier: Apache-2.0
// Each family of beam shapes at its best under each offset, and how much the readings are for it.
// Internal to this room.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "lightcal/fit/beam/beam_problem.h"
#include "lightcal/fit/beam/beam_profile.h"

namespace lightcal::fit {

struct SolvedBeam {
  BeamShape shape;
  bool smooth = false;
  double outermost = 0.0;  // rad, of the readings that saw light; of a smooth curve
  double ln_axial = 0.0;
  Eigen::VectorXd axial;  // how ln I(0) goes with theta
  double ln_probability = -std::numeric_limits<double>::infinity();
  double share = 0.0;      // of all
  std::size_t offset = 0;  // of the readings' offsets, the one it was solved under
  Eigen::VectorXd theta;
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd root;           // covariance = root root'
  double chi2 = 0.0, told = 0.0;  // told: directions that the readings decided
  double leave_one_out = 0.0;     // rms of each lit row predicted by the others, over its sigma
  std::vector<double> predicted_lx, walls_lx, gamma_rad;  // beside the rows
};

// Posterior modes with their curvature (Laplace), likeliest first, those of next to no share left
// out. Empty where the solver found none.
[[nodiscard]] std::vector<SolvedBeam> SolveBeams(const BeamReadings& readings);

}  // namespace lightcal::fit
