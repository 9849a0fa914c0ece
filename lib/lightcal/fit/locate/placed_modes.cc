// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/placed_modes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lightcal/core/uncertain.h"
#include "lightcal/fit/locate/locate_refusals.h"
#include "lightcal/fit/model/evidence.h"

namespace lightcal::fit {
namespace {

constexpr int kRounds = 4;             // of settling what the walls scatter
constexpr double kLeastShare = 0.005;  // of a place
constexpr double kDistinct = 30.0;     // squared Mahalanobis distance of another place
constexpr double kSamePoint = 1e-3;    // of the distance

std::optional<PlacedMode> ModeAt(PlacedEstimation estimation, PlacedTheta theta,
                                 const WallHypothesis* walls) {
  for (int i = 0; estimation.rules[kPlacedLnWalls].free && i < kRounds; ++i) {
    const auto solved = SolvePlaced(estimation, theta);
    if (!solved) return std::nullopt;
    theta = *solved;
    SettleScatter(estimation, theta);
  }
  auto covariance = EstimatePlacedCovariance(estimation, theta, {});
  if (!covariance) return std::nullopt;
  double ln = LnEvidenceOf(estimation, theta);
  std::optional<WallPrior> prior;
  if (walls != nullptr) {
    ln += std::log(walls->weight);
    prior = walls->prior;
  }
  return PlacedMode{std::move(estimation), theta, *covariance, prior, ln, 1.0};
}

bool AreOne(const PlacedMode& a, const PlacedMode& b) {
  return Length(LampOf(a.theta) - LampOf(b.theta)) < kSamePoint * Length(LampOf(a.theta)) &&
         std::abs(a.theta[kPlacedLnIntensity] - b.theta[kPlacedLnIntensity]) < kSamePoint;
}

bool IsOfPlace(const PlacedMode& one, const PossiblePlace& place) {
  const PlacedMode& best = place.modes.front();
  const Vec3 d = LampOf(one.theta) - LampOf(best.theta);
  const Eigen::Vector3d apart(d[0], d[1], d[2]);
  const Eigen::Matrix3d block = PositionBlock(best.covariance) + PositionBlock(one.covariance);
  return apart.dot(Eigen::LDLT<Eigen::Matrix3d>(block).solve(apart)) <= kDistinct;
}

// Whether some meter sees the lamp by more than a grazing ray. No lux meter tells light that grazes
// its face: nobody reads a lamp so, but beside walls whose light is open such a lamp explains all.
bool SomeMeterFaces(const PlacedMode& mode) {
  constexpr double kGrazing = 0.15;  // cosine, 81 degrees
  return std::ranges::any_of(mode.estimation.rows, [&](const PlacedRow& row) {
    if (!(row.direct_gain > 0.0) || !row.position || !row.normal) return row.direct_gain > 0.0;
    const Vec3 way = LampOf(mode.theta) - *row.position;
    return Dot(way, *row.normal) > kGrazing * Length(way);
  });
}

void ShareOut(PossiblePlace& place) {
  const double most = place.modes.front().ln_probability;
  double whole = 0.0;
  for (PlacedMode& one : place.modes) whole += one.share = std::exp(one.ln_probability - most);
  place.ln_probability = most + std::log(whole);
  std::erase_if(place.modes,
                [&](const PlacedMode& one) { return one.share < kLeastShare * whole; });
  whole = 0.0;
  for (const PlacedMode& one : place.modes) whole += one.share;
  for (PlacedMode& one : place.modes) one.share /= whole;
}

}  // namespace

Eigen::Matrix3d PositionBlock(const PlacedCovariance& covariance) {
  Eigen::Matrix3d block;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      block(i, j) = covariance[(kPlacedX + i) * kPlacedParameters + kPlacedX + j];
    }
  }
  return block;
}

double LargestU95(const PlacedCovariance& covariance) {
  const double variance =
      PositionBlock(covariance).selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff();
  return kZ95 * std::sqrt(variance);
}

std::vector<PossiblePlace> PossiblePlaces(const PlacedProblem& problem,
                                          const std::vector<PlacedSolution>& solutions,
                                          const std::vector<WallHypothesis>& walls) {
  std::vector<PlacedMode> modes;
  const auto add = [&](const PlacedEstimation& estimation, const WallHypothesis* hypothesis) {
    const std::size_t first = modes.size();
    for (const PlacedSolution& start : solutions) {
      if (start.chi_squared > solutions.front().chi_squared + kAllowedChiSquared) break;
      auto mode = ModeAt(estimation, start.theta, hypothesis);
      if (!mode) continue;
      const bool known =
          std::any_of(modes.begin() + static_cast<std::ptrdiff_t>(first), modes.end(),
                      [&](const PlacedMode& one) { return AreOne(one, *mode); });
      if (!known) modes.push_back(*std::move(mode));
    }
  };
  if (problem.estimation.rules[kPlacedLnWalls].free) {
    for (const WallHypothesis& one : walls) {
      PlacedEstimation estimation = problem.estimation;
      SetWalls(one.prior, estimation);
      add(estimation, &one);
    }
  } else {
    add(problem.estimation, nullptr);
  }
  if (std::ranges::any_of(modes, SomeMeterFaces)) {
    std::erase_if(modes, [](const PlacedMode& one) { return !SomeMeterFaces(one); });
  }
  std::ranges::stable_sort(modes, std::ranges::greater(), &PlacedMode::ln_probability);
  std::vector<PossiblePlace> places;
  for (PlacedMode& mode : modes) {
    const auto place = std::ranges::find_if(
        places, [&](const PossiblePlace& other) { return IsOfPlace(mode, other); });
    if (place != places.end()) {
      place->modes.push_back(std::move(mode));
    } else {
      places.emplace_back().modes.push_back(std::move(mode));
    }
  }
  for (PossiblePlace& place : places) ShareOut(place);
  std::ranges::stable_sort(places, std::ranges::greater(), &PossiblePlace::ln_probability);
  std::erase_if(places, [&](const PossiblePlace& place) {
    return place.ln_probability < places.front().ln_probability - 0.5 * kAllowedChiSquared;
  });
  return places;
}

MixedPlace MixOf(const std::vector<PlacedMode>& modes,
                 const std::vector<PlacedCovariance>& covariances) {
  MixedPlace out;
  for (const PlacedMode& one : modes) {
    for (int k = 0; k < kPlacedParameters; ++k) out.theta[k] += one.share * one.theta[k];
  }
  for (std::size_t n = 0; n < modes.size(); ++n) {
    const PlacedTheta& theta = modes[n].theta;
    for (int i = 0; i < kPlacedParameters; ++i) {
      for (int j = 0; j < kPlacedParameters; ++j) {
        const int at = i * kPlacedParameters + j;
        out.covariance[at] += modes[n].share * (covariances[n][at] + (theta[i] - out.theta[i]) *
                                                                         (theta[j] - out.theta[j]));
      }
    }
  }
  return out;
}

}  // namespace lightcal::fit
