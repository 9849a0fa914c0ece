// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/solve_aims.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/core/units.h"
#include "lightcal/imaging/panorama/aim_bundle.h"
#include "lightcal/imaging/panorama/aim_covariance.h"
#include "lightcal/imaging/panorama/view_tree.h"

namespace lightcal {
namespace {

constexpr double kFocalSd = 0.03, kFreeFocalSd = 1.0;
constexpr double kToleranceShare = 0.006;  // of RANSAC, of the longer side
constexpr double kNarrowest = 25.0, kWidestRect = 120.0, kWidestFisheye = 220.0, kFovStep = 1.06;
constexpr std::size_t kPairsThatChoose = 12;
constexpr std::size_t kMostMatches = 9000, kLeastOfPair = 30, kMostOfPair = 250;
constexpr int kBundleRounds = 7, kLensPasses = 3;

// Below which 95 % of a length lie whose three coordinates have this covariance; the sum of squares
// as a scaled chi-square (Satterthwaite), its quantile by Wilson & Hilferty.
double Length95(const Eigen::Matrix3d& covariance) {
  constexpr double kOneSided95 = 1.6449;
  const double trace = covariance.trace(), square = (covariance * covariance).trace();
  if (!(trace > 0.0)) return 0.0;
  const double freedom = trace * trace / square, part = 2.0 / (9.0 * freedom);
  const double quantile = freedom * std::pow(1.0 - part + kOneSided95 * std::sqrt(part), 3);
  return std::sqrt(trace / freedom * quantile);
}

std::vector<TurnedPair> AgreeingPairs(const AimQuestion& question,
                                      const std::vector<ViewPair>& pairs,
                                      const ViewOptics& optics) {
  const double tolerance = kToleranceShare * std::max(question.view.width, question.view.height);
  std::vector<TurnedPair> turned;
  for (const ViewPair& pair : pairs) {
    TurnedPair found = TurnOfPair(pair, question.features, optics, tolerance);
    if (BelongTogether(found.pair.matches.size(), pair.matches.size())) {
      turned.push_back(std::move(found));
    }
  }
  return turned;
}

// The focal length under which most matches of the likeliest pairs are rotations.
double FocalThatAgrees(const AimQuestion& question, std::vector<ViewPair> pairs) {
  std::ranges::stable_sort(pairs, [](const ViewPair& a, const ViewPair& b) {
    return a.matches.size() > b.matches.size();
  });
  pairs.resize(std::min(pairs.size(), kPairsThatChoose));
  const bool rect = question.view.projection == Projection::kRectilinear;
  double best = 0.0;
  std::size_t most = 0;
  for (double degrees = kNarrowest; degrees < (rect ? kWidestRect : kWidestFisheye);
       degrees *= kFovStep) {
    PictureView view = question.view;
    view.field_of_view = RadiansFromDegrees(degrees);
    const double focal = FocalOf(view);
    std::size_t agreeing = 0;
    for (const ViewPair& pair : pairs) {
      // Half the usual tolerance tells focal lengths apart.
      const double tolerance = 0.5 * kToleranceShare * std::max(view.width, view.height);
      agreeing +=
          TurnOfPair(pair, question.features, {view, focal, {}}, tolerance).pair.matches.size();
    }
    if (agreeing <= most) continue;
    most = agreeing;
    best = focal;
  }
  return best;
}

AimBundle BundleOf(const AimQuestion& question, const ViewTree& tree) {
  AimBundle bundle;
  bundle.view = question.view;
  for (const CameraAxes& axes : tree.axes) {
    Eigen::Matrix3d placed;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Vec3& axis = axes[static_cast<std::size_t>(i)];
      placed.col(i) << axis[0], axis[1], axis[2];
    }
    bundle.turns.push_back(placed);
  }
  const std::size_t most = std::clamp(kMostMatches / std::max<std::size_t>(1, tree.pairs.size()),
                                      kLeastOfPair, kMostOfPair);
  const auto point = [](const PictureFeature& f) { return std::array{double{f.x}, double{f.y}}; };
  for (const TurnedPair& edge : tree.pairs) {
    const auto& matches = edge.pair.matches;
    const std::size_t count = std::min(most, matches.size());
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [a, b] = matches[i * matches.size() / count];
      AimMatch match;
      match.a = edge.pair.a;
      match.b = edge.pair.b;
      match.at_a = point(question.features[match.a][a]);
      match.at_b = point(question.features[match.b][b]);
      bundle.matches.push_back(match);
    }
  }
  return bundle;
}

AimVector SolveBundle(AimBundle& bundle, const ViewOptics& start) {
  AimVector at = AimVector::Zero(bundle.Size());
  at.tail<kAimLensParameters>() << std::log(start.focal_px), start.lens.a, start.lens.b;
  for (int round = 0; round < kBundleRounds; ++round) {
    SetAimTangents(bundle, at);
    ReweighAims(bundle, at);
    ceres::TinySolver<AimRows> solver;
    solver.options.max_num_iterations = 12;
    solver.options.initial_trust_region_radius = 1e8;
    solver.options.function_tolerance = 1e-9;
    const AimRows rows{bundle};
    solver.Solve(rows, &at);
    FoldAimTurns(bundle, at);
  }
  SetAimTangents(bundle, at);
  ReweighAims(bundle, at);
  return at;
}

SolvedAims AimsOf(const AimBundle& bundle, const AimVector& at) {
  const AimMatrix covariance = CovarianceOfAims(bundle, at);
  SolvedAims aims;
  aims.focal_px = std::exp(at[bundle.Lens()]);
  aims.lens = {at[bundle.Lens() + 1], at[bundle.Lens() + 2]};
  aims.rms_px = bundle.sd_px;
  aims.matches = bundle.matches.size();
  const Eigen::Matrix3d& first = bundle.turns.front();
  for (std::size_t v = 0; v < bundle.turns.size(); ++v) {
    // Rows of camera axes in the first camera's.
    const Eigen::Matrix3d rows = (first.transpose() * bundle.turns[v]).transpose();
    CameraAxes axes{};
    for (Eigen::Index i = 0; i < 3; ++i) {
      axes[static_cast<std::size_t>(i)] = {rows(i, 0), rows(i, 1), rows(i, 2)};
    }
    aims.axes.push_back(axes);
    const auto place = static_cast<Eigen::Index>(3 * v);
    const Eigen::Matrix3d own = covariance.block<3, 3>(place, place);
    aims.u95_deg.push_back(Length95(own) / kRadiansPerDegree);
  }
  return aims;
}

}  // namespace

Result<SolvedAims> SolveAims(const AimQuestion& question) {
  const std::vector<ViewPair> pairs = MatchViews(question.features);
  const bool known = question.view.field_of_view.value() > 0.0;
  double focal = known ? FocalOf(question.view) : FocalThatAgrees(question, pairs);
  if (!(focal > 0.0)) focal = 0.8 * question.view.width;  // nothing agrees: the tree will say so
  ViewOptics optics{question.view, focal, {}};
  AimBundle bundle;
  AimVector at;
  // Again with the lens that was found: a wrong one keeps only the matches that suit it.
  for (int pass = 0; pass < kLensPasses; ++pass) {
    const auto tree = TreeOfViews(question.names, AgreeingPairs(question, pairs, optics));
    if (!tree) return tl::unexpected(tree.error());
    bundle = BundleOf(question, *tree);
    bundle.ln_focal = std::log(focal);
    bundle.ln_focal_sd = known ? kFocalSd : kFreeFocalSd;
    at = SolveBundle(bundle, optics);
    if (!at.allFinite()) {
      return Refused("views_do_not_overlap", question.names.front(),
                     "no turns of the views fit what they share; give {view.aims}");
    }
    optics.focal_px = std::exp(at[bundle.Lens()]);
    optics.lens = {at[bundle.Lens() + 1], at[bundle.Lens() + 2]};
  }
  return AimsOf(bundle, at);
}

}  // namespace lightcal
