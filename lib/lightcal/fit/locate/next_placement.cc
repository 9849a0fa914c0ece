// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/next_placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lightcal/core/uncertain.h"
#include "lightcal/fit/locate/placed_starts.h"

namespace lightcal::fit {
namespace {

constexpr int kPlacementSteps = 4;  // to each side
constexpr int kSpaceSteps = 2;
constexpr double kTellsApart = 5.0;  // sigma
constexpr double kVague = 3.0;       // prior of the position, in distances from the meters

Vec3 LampOf(const PlacedTheta& theta) {
  return {theta[kPlacedX], theta[kPlacedY], theta[kPlacedZ]};
}

// How far the person went with the meter.
double ReachOf(const PlacedEstimation& estimation, const Layout& layout) {
  double reach = 0.0;
  for (const PlacedRow& row : estimation.rows) {
    if (row.position && row.direct_gain > 0.0) {
      reach = std::max(reach, Length(*row.position - layout.middle));
    }
  }
  return reach > 0.0 ? reach : layout.extent;
}

std::vector<Vec3> CandidatesOf(const PlacedEstimation& estimation, const Layout& layout) {
  const double reach = ReachOf(estimation, layout);
  std::vector<Vec3> out;
  if (const auto plane = CommonPlaneOf(estimation.rows)) {
    const double step = reach / kPlacementSteps;
    for (int i = -kPlacementSteps; i <= kPlacementSteps; ++i) {
      for (int j = -kPlacementSteps; j <= kPlacementSteps; ++j) {
        out.push_back(layout.middle + plane->across * (i * step) + plane->along * (j * step));
      }
    }
    return out;
  }
  const double step = reach / kSpaceSteps;
  for (int i = -kSpaceSteps; i <= kSpaceSteps; ++i) {
    for (int j = -kSpaceSteps; j <= kSpaceSteps; ++j) {
      for (int k = -kSpaceSteps; k <= kSpaceSteps; ++k) {
        out.push_back(layout.middle + Vec3{i * step, j * step, k * step});
      }
    }
  }
  return out;
}

// The normal a further reading would have: the mean of all, facing where some have none.
std::optional<Vec3> NormalOf(const PlacedEstimation& estimation) {
  Vec3 sum{};
  for (const PlacedRow& row : estimation.rows) {
    if (!row.position || !(row.direct_gain > 0.0)) continue;
    if (!row.normal) return std::nullopt;
    sum = sum + *row.normal;
  }
  const double length = Length(sum);
  if (!(length > 1e-9)) return std::nullopt;
  return sum * (1.0 / length);
}

// Not under the floor, which lies no higher than the lowest reading nor above z = 0, and not where
// a reading stands already.
class FreePlaces {
 public:
  FreePlaces(const PlacedEstimation& estimation, const PlacedFrame& frame) {
    for (const PlacedRow& row : estimation.rows) {
      if (!row.position) continue;
      taken_.push_back(frame.origin + *row.position * frame.length_m);
      floor_m_ = std::min(floor_m_, taken_.back()[2]);
    }
  }
  [[nodiscard]] bool Has(const Vec3& place_m) const {
    constexpr double kRounding_m = 0.006;
    return place_m[2] >= floor_m_ - kRounding_m &&
           std::ranges::none_of(
               taken_, [&](const Vec3& one) { return Length(one - place_m) < kRounding_m; });
  }

 private:
  std::vector<Vec3> taken_;
  double floor_m_ = 0.0;
};

Vec3 Rounded(const Vec3& metres, double reach_m) {
  const double per_metre = reach_m < 1.0 ? 1000.0 : 100.0;
  const auto round = [&](double x) { return std::round(x * per_metre) / per_metre; };
  return {round(metres[0]), round(metres[1]), round(metres[2])};
}

double FinestSigma(const PlacedEstimation& estimation) {
  double sigma = std::numeric_limits<double>::infinity();
  for (const PlacedRow& row : estimation.rows) {
    if (row.form == RowForm::kLog) sigma = std::min(sigma, row.sigma);
  }
  return std::isfinite(sigma) ? sigma : 0.05;
}

class Judge {
 public:
  Judge(const PlacedEstimation& estimation, std::span<const PlacedTheta> solutions, bool separate)
      : with_(estimation),
        solutions_(solutions),
        separate_(separate),
        middle_(LayoutOf(estimation.rows).middle) {
    PlacedRow row;
    row.normal = NormalOf(estimation);
    row.sigma = FinestSigma(estimation);
    // It sees the walls as the others do.
    const auto seeing = std::ranges::find_if(
        estimation.rows, [](const PlacedRow& one) { return one.direct_gain > 0.0 && one.walls; });
    if (seeing != estimation.rows.end()) row.walls = seeing->walls;
    const auto lit = std::ranges::find_if(
        estimation.rows, [](const PlacedRow& one) { return one.direct_gain > 0.0; });
    if (lit != estimation.rows.end()) row.face = lit->face;
    with_.rows.push_back(row);
  }

  [[nodiscard]] const std::optional<Vec3>& normal() const { return with_.rows.back().normal; }

  // Geometric mean of the position's standard deviation over the solutions; infinite where the
  // reading is impossible or does not separate what it should.
  double Score(const Vec3& position) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    PlacedRow& row = with_.rows.back();
    row.position = position;
    std::vector<double> ln_lux;
    double sum = 0.0;
    for (const PlacedTheta& theta : solutions_) {
      double lux = 0.0;
      if (!PlacedIlluminance(row, with_.aim, theta.data(), &lux)) return kNever;
      row.measured = lux;
      ln_lux.push_back(std::log(lux));
      const double distance = Length(LampOf(theta) - middle_);
      const auto sd = PositionSd(theta, distance);
      if (!sd) return kNever;
      sum += std::log(*sd);
    }
    for (std::size_t i = 1; separate_ && i < ln_lux.size(); ++i) {
      if (std::abs(ln_lux[i] - ln_lux.front()) < kTellsApart * row.sigma) return kNever;
    }
    return std::exp(sum / static_cast<double>(solutions_.size()));
  }

 private:
  [[nodiscard]] std::optional<double> PositionSd(const PlacedTheta& theta, double distance) const {
    PlacedUncertainty input;
    input.position_sd = kVague * distance;
    const auto covariance = EstimatePlacedCovariance(with_, theta, input);
    if (!covariance) return std::nullopt;
    double trace = 0.0;
    for (int k = kPlacedX; k <= kPlacedZ; ++k) trace += (*covariance)[k * kPlacedParameters + k];
    return std::sqrt(trace);
  }

  PlacedEstimation with_;
  std::span<const PlacedTheta> solutions_;
  bool separate_;
  Vec3 middle_;
};

}  // namespace

std::optional<Placement> BestPlacement(const PlacedEstimation& estimation,
                                       std::span<const PlacedTheta> solutions, bool separate,
                                       const PlacedFrame& frame) {
  if (solutions.empty()) return std::nullopt;
  const Layout layout = LayoutOf(estimation.rows);
  const double reach_m = ReachOf(estimation, layout) * frame.length_m;
  Judge judge(estimation, solutions, separate);
  std::optional<Placement> best;
  double least = std::numeric_limits<double>::infinity();
  const FreePlaces places(estimation, frame);
  for (const Vec3& candidate : CandidatesOf(estimation, layout)) {
    const Vec3 metres = Rounded(frame.origin + candidate * frame.length_m, reach_m);
    if (!places.Has(metres)) continue;
    const double score = judge.Score((metres - frame.origin) * (1.0 / frame.length_m));
    // Equal but for rounding: the first, so that the answer does not depend on the last digit.
    if (!(score < least * (1.0 - 1e-6))) continue;
    least = score;
    best = Placement{metres, judge.normal(), kZ95 * score * frame.length_m};
  }
  return best;
}

}  // namespace lightcal::fit
