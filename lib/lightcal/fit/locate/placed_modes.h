// SPDX-License-Identifier: Apache-2.0
// What a lamp of unknown place may be and where it may stand, each weighed by how well it explains
// the readings. Internal to locate.cc.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lightcal/fit/locate/locate_search.h"
#include "lightcal/light/wall_prior.h"

namespace lightcal::fit {

// The lamp as one hypothesis has it, near one minimum of the search.
struct PlacedMode {
  PlacedEstimation estimation;  // the scatter of its walls settled
  PlacedTheta theta{};
  PlacedCovariance covariance{};  // of rows and priors alone
  std::optional<WallPrior> walls;
  double ln_probability = 0.0;
  double share = 1.0;  // among those of its place
};

// A place beyond the others' intervals: its modes, the likeliest first, those of under half a
// percent left out.
struct PossiblePlace {
  std::vector<PlacedMode> modes;
  double ln_probability = 0.0;  // of them together
};

// Each minimum that the readings allow, under each hypothesis (no walls: as it is). The likeliest
// place first; those a hundred times less likely are left out, and those whose light would graze
// every meter's face.
[[nodiscard]] std::vector<PossiblePlace> PossiblePlaces(
    const PlacedProblem& problem, const std::vector<PlacedSolution>& solutions,
    const std::vector<WallHypothesis>& walls);

// Of the coordinates alone.
[[nodiscard]] Eigen::Matrix3d PositionBlock(const PlacedCovariance& covariance);

// u95 of the place along the direction it is known worst in.
[[nodiscard]] double LargestU95(const PlacedCovariance& covariance);

// Mean and covariance of a place's modes, whose own covariances lie beside them.
struct MixedPlace {
  PlacedTheta theta{};
  PlacedCovariance covariance{};
};
[[nodiscard]] MixedPlace MixOf(const std::vector<PlacedMode>& modes,
                               const std::vector<PlacedCovariance>& covariances);

}  // namespace lightcal::fit
