// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/locate_refusals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/locate/placed_modes.h"
#include "lightcal/fit/locate/placed_starts.h"

namespace lightcal::fit {
namespace {

constexpr std::size_t kMostFamily = 10;
constexpr double kVague_m = 5.0;  // u95 that is no advice beside a better one

// One of each cluster of solutions that the readings allow, where a lamp of a room may be. Where
// they leave a line of places open, the search ends anywhere on it: places along it stand for all.
std::vector<PlacedTheta> FamilyOf(const PlacedProblem& problem,
                                  const std::vector<PlacedSolution>& found) {
  constexpr double kNearest = 0.3;  // in extents of the layout
  constexpr double kFarthest = 5.0;
  std::vector<PlacedTheta> out;
  std::vector<PlacedSolution> solutions = found;
  const double least = found.empty() ? 0.0 : found.front().chi_squared;
  if (problem.lit >= kFewestPlacedReadings) {
    std::ranges::copy(OpenPlaces(problem, least), std::back_inserter(solutions));
  }
  for (const PlacedSolution& s : solutions) {
    if (s.chi_squared > least + kAllowedChiSquared) continue;
    const bool known = std::ranges::any_of(
        out, [&](const PlacedTheta& other) { return AtOnePlace(s.theta, other); });
    if (!known) out.push_back(s.theta);
    if (out.size() == kMostFamily) break;
  }
  std::vector<PlacedTheta> usual;
  std::ranges::copy_if(out, std::back_inserter(usual), [](const PlacedTheta& theta) {
    const double distance = Length(LampOf(theta));
    return distance > kNearest && distance < kFarthest;
  });
  return usual.empty() ? out : usual;
}

// In whole millimetres.
std::string PointText(const Vec3& p) {
  const auto text = [](double x) { return ShortestText(std::round(1000.0 * x) / 1000.0); };
  return "[" + text(p[0]) + ", " + text(p[1]) + ", " + text(p[2]) + "]";
}

// u95 of the lamp's place in metres, were every reading taken again behind a shadow card.
std::optional<double> BehindCards_m(const PlacedProblem& problem, const PlacedTheta& theta) {
  PlacedEstimation estimation = problem.estimation;
  bool seen = false;
  for (PlacedRow& row : estimation.rows) {
    if (!(row.direct_gain > 0.0) || !row.walls) continue;
    double lux = 0.0;
    if (!PlacedIlluminance(row, estimation.aim, theta.data(), &lux)) return std::nullopt;
    const double walls = std::exp(theta[kPlacedLnIntensity]) *
                         WallsPerCandela(row, DistanceOf(row, theta.data()), theta.data());
    // Two readings, what is left being smaller than both.
    row.measured = lux - walls;
    row.sigma = row.own_sigma * std::hypot(lux, walls) / row.measured;
    row.walls.reset();
    seen = true;
  }
  if (!seen) return std::nullopt;
  const auto covariance = EstimatePlacedCovariance(estimation, theta, {});
  if (!covariance) return std::nullopt;
  return LargestU95(*covariance) * problem.frame.length_m;
}

std::string CardText(const PlacedProblem& problem, const std::vector<PlacedTheta>& solutions) {
  if (problem.lit < kFewestPlacedReadings || solutions.empty()) return "";
  const auto u95_m = BehindCards_m(problem, solutions.front());
  if (!u95_m || !(*u95_m < 1.0)) return "";
  return "; or read each of these again behind a shadow card, since it is the light from the walls "
         "that leaves it open: +-" +
         RoundedText(*u95_m, 2) + " m";
}

std::string CureText(const PlacedProblem& problem, const std::vector<PlacedTheta>& solutions,
                     bool separate) {
  const auto place = BestPlacement(problem.estimation, solutions, separate, problem.frame);
  const std::string cards = CardText(problem, solutions);
  if (!place || (place->lamp_u95_m > kVague_m && !cards.empty())) {
    return "add a reading well away from the others, or give the lamp's position_m" + cards;
  }
  return "add a reading at position_m = " + PointText(place->position) +
         (place->normal ? ", normal = " + PointText(*place->normal) : " facing the lamp") +
         (problem.lit + 1 < kFewestPlacedReadings
              ? " first"
              : ": it would bring the lamp's position to about +-" +
                    RoundedText(place->lamp_u95_m, 2) + " m") +
         cards;
}

// Whether all meters of one normal stand on one circle or one line.
struct Circle {
  bool exact = false;
  bool line = false;
};
std::optional<Circle> OnOneCircle(const PlacedProblem& problem) {
  const auto plane = CommonPlaneOf(problem.estimation.rows);
  if (!plane) return std::nullopt;
  std::vector<Eigen::Vector2d> points;
  for (const PlacedRow& row : problem.estimation.rows) {
    if (!row.position || !(row.direct_gain > 0.0)) continue;
    const Vec3 p = *row.position - plane->origin;
    points.emplace_back(Dot(p, plane->across), Dot(p, plane->along));
  }
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd a(n, 4);  // alpha |p|^2 + beta x + gamma y + delta = 0, of unit length
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector2d& p = points[static_cast<std::size_t>(i)];
    a.row(i) << p.squaredNorm(), p.x(), p.y(), 1.0;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeFullV);
  const Eigen::Vector4d worst = svd.matrixV().col(3);
  double off = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) off = std::max(off, std::abs(a.row(i).dot(worst)));
  constexpr double kNearly = 0.03;
  if (n >= 4 && off > kNearly) return std::nullopt;
  return Circle{off < 1e-6, std::abs(worst[0]) < 1e-6};
}

}  // namespace

bool NearlyOnOneCircle(const PlacedProblem& problem) { return OnOneCircle(problem).has_value(); }

bool OnOneCircleExactly(const PlacedProblem& problem) {
  const auto circle = OnOneCircle(problem);
  return circle && circle->exact;
}

tl::unexpected<Error> RefuseLayout(const PlacedProblem& problem,
                                   const std::vector<PlacedSolution>& solutions,
                                   const std::string& light) {
  const std::string cure = CureText(problem, FamilyOf(problem, solutions), false);
  if (problem.lit < kFewestPlacedReadings) {
    return Refused("position_unknown", light,
                   "readings give position_m, but the lamp has none, and it takes four readings, "
                   "not all on one circle, to find it (here " +
                       std::to_string(problem.lit) + "): " + cure +
                       "; or add position_m to its [[light]], or give distance_m in each reading");
  }
  if (const auto circle = OnOneCircle(problem)) {
    return Refused("cocircular", light,
                   std::string("the meters stood on one ") + (circle->line ? "line" : "circle") +
                       (circle->exact ? "" : ", nearly") +
                       ", which leaves the lamp's height and strength open: " + cure);
  }
  return Refused("underdetermined", light,
                 "these places tell next to nothing of the lamp's position: " + cure);
}

tl::unexpected<Error> RefuseMirror(const PlacedProblem& problem,
                                   const std::vector<PlacedSolution>& apart,
                                   const std::string& light) {
  const auto at = [&](const PlacedSolution& one) {
    return PointText(problem.frame.origin + LampOf(one.theta) * problem.frame.length_m);
  };
  std::vector<PlacedTheta> thetas;
  for (const PlacedSolution& one : apart) thetas.push_back(one.theta);
  return Refused("mirror_ambiguous", light,
                 "a lamp at " + at(apart[0]) + " explains these readings as well as one at " +
                     at(apart[1]) + "; nothing tells which: " + CureText(problem, thetas, true));
}

}  // namespace lightcal::fit
