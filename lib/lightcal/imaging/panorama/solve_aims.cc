// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/solve_aims.h"

#include <ceres/jet.h>
#include <ceres/tiny_solver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "lightcal/core/statistics.h"
#include "lightcal/imaging/panorama/view_tree.h"

namespace lightcal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kFocalSd = 0.03, kFreeFocalSd = 1.0, kBendSd = 0.03;
constexpr double kToleranceShare = 0.006;  // of RANSAC, of the longer side
constexpr double kNarrowest = 25.0, kWidestRect = 120.0, kWidestFisheye = 220.0, kFovStep = 1.06;
constexpr std::size_t kPairsThatChoose = 12;
constexpr std::size_t kMostMatches = 9000, kLeastOfPair = 30, kMostOfPair = 250;
constexpr double kAimCauchy = 2.385, kAimMad = 1.4826;
constexpr int kBundleRounds = 7, kLensParameters = 3, kLensPasses = 3;
constexpr double kField = 6.0 * kDegree;  // on a side, of common errors
constexpr double kUnseenBend = 1e-4;      // rims, of a term of ExtraBend that nothing shows
constexpr int kExtraBends = 6, kBendRounds = 30;
constexpr double kGaugeSd = 1e-5;         // radians, of the mean turn
constexpr double kAimSd = 10.0 * kDegree;  // of a view that one field alone holds

using AimVector = Eigen::VectorXd;
using AimMatrix = Eigen::MatrixXd;

struct BundleMatch {
  std::size_t a = 0, b = 0;
  std::array<double, 2> at_a{}, at_b{};
  Eigen::Vector3d across = Eigen::Vector3d::Zero(), along = Eigen::Vector3d::Zero();
  double weight = 1.0;
};

// Parameters: a turn of every view in the place's axes, then ln f, a, b. A turn w is the rotation
// of Gibbs's vector g = w/2, by 2 atan |g| about g: v + 2 g x (v + g x v)/(1 + g^2).
struct Bundle {
  PictureView view;
  std::vector<Eigen::Matrix3d> turns;  // place from camera, at turn 0
  std::vector<BundleMatch> matches;
  double ln_focal = 0.0, ln_focal_sd = kFocalSd;
  double sd_px = 1.0;

  [[nodiscard]] int Lens() const { return 3 * static_cast<int>(turns.size()); }
  [[nodiscard]] int Size() const { return Lens() + kLensParameters; }
  [[nodiscard]] int Rows() const {
    return 2 * static_cast<int>(matches.size()) + Size() - Lens() + 3;
  }
};

template <class T>
Vec3Of<T> TurnedBy(const T* turn, const Vec3Of<T>& v) {
  const Vec3Of<T> g{turn[0] / 2.0, turn[1] / 2.0, turn[2] / 2.0};
  const T share = 2.0 / (1.0 + Dot(g, g));
  return v + Cross(g, v + Cross(g, v)) * share;
}

template <class T>
Vec3Of<T> Turned(const Bundle& bundle, std::size_t view, const std::array<double, 2>& point,
                 const T* turn, const T* lens) {
  using std::exp;
  const Vec3Of<T> seen = BearingOf(bundle.view, point, T(exp(lens[0])), lens[1], lens[2]);
  const Eigen::Matrix3d& m = bundle.turns[view];
  Vec3Of<T> placed;
  for (Eigen::Index i = 0; i < 3; ++i) {
    placed[static_cast<std::size_t>(i)] = m(i, 0) * seen[0] + m(i, 1) * seen[1] + m(i, 2) * seen[2];
  }
  return TurnedBy(turn, placed);
}

// Two coordinates of a match's misfit in pixels of the middle.
template <class T>
std::array<T, 2> Misfit(const Bundle& bundle, const BundleMatch& match, const T* turn_a,
                        const T* turn_b, const T* lens) {
  const auto a = Turned(bundle, match.a, match.at_a, turn_a, lens);
  const auto b = Turned(bundle, match.b, match.at_b, turn_b, lens);
  const double focal = std::exp(bundle.ln_focal);
  std::array<T, 2> out{T(0.0), T(0.0)};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    out[0] += (a[k] - b[k]) * (focal * match.across[i]);
    out[1] += (a[k] - b[k]) * (focal * match.along[i]);
  }
  return out;
}

// Rows over their sd, weights' roots in them; then the lens's priors and the gauge.
struct BundleRows {
  using Scalar = double;
  enum : int { NUM_PARAMETERS = Eigen::Dynamic, NUM_RESIDUALS = Eigen::Dynamic };
  const Bundle& bundle;

  [[nodiscard]] int NumParameters() const { return bundle.Size(); }
  [[nodiscard]] int NumResiduals() const { return bundle.Rows(); }

  bool operator()(const double* at, double* residuals, double* jacobian) const {
    using Nine = ceres::Jet<double, 9>;
    const int rows = NumResiduals(), lens = bundle.Lens();
    if (jacobian != nullptr) {
      std::fill_n(jacobian, static_cast<std::size_t>(rows) * NumParameters(), 0.0);
    }
    const auto derivative = [&](int row, int column) -> double& {
      return jacobian[static_cast<std::size_t>(column) * rows + row];
    };
    int row = 0;
    for (const BundleMatch& match : bundle.matches) {
      const int a = 3 * static_cast<int>(match.a), b = 3 * static_cast<int>(match.b);
      std::array<Nine, 9> local;
      for (int k = 0; k < 3; ++k) {
        local[k] = Nine(at[a + k], k);
        local[3 + k] = Nine(at[b + k], 3 + k);
        local[6 + k] = Nine(at[lens + k], 6 + k);
      }
      const auto misfit = Misfit(bundle, match, local.data(), local.data() + 3, local.data() + 6);
      const double scale = std::sqrt(match.weight) / bundle.sd_px;
      for (const Nine& part : misfit) {
        residuals[row] = scale * part.a;
        for (int k = 0; k < 3 && jacobian != nullptr; ++k) {
          derivative(row, a + k) = scale * part.v[k];
          derivative(row, b + k) = scale * part.v[3 + k];
          derivative(row, lens + k) = scale * part.v[6 + k];
        }
        ++row;
      }
    }
    for (int k = 0; k < kLensParameters; ++k, ++row) {
      const double mean = k == 0 ? bundle.ln_focal : 0.0;
      const double sd = k == 0 ? bundle.ln_focal_sd : kBendSd;
      residuals[row] = (at[lens + k] - mean) / sd;
      if (jacobian != nullptr) derivative(row, lens + k) = 1.0 / sd;
    }
    const auto views = static_cast<int>(bundle.turns.size());
    for (int k = 0; k < 3; ++k, ++row) {
      residuals[row] = 0.0;
      for (int v = 0; v < views; ++v) {
        residuals[row] += at[3 * v + k] / views / kGaugeSd;
        if (jacobian != nullptr) derivative(row, 3 * v + k) = 1.0 / views / kGaugeSd;
      }
    }
    return true;
  }
};

void SetTangents(Bundle& bundle, const AimVector& at) {
  const double* const lens = at.data() + bundle.Lens();
  for (BundleMatch& match : bundle.matches) {
    const auto d = Turned(bundle, match.a, match.at_a, at.data() + 3 * match.a, lens);
    const Eigen::Vector3d seen(d[0], d[1], d[2]);
    match.across = seen.unitOrthogonal();
    match.along = seen.cross(match.across);
  }
}

std::array<double, 2> MisfitAt(const Bundle& bundle, const BundleMatch& match,
                               const AimVector& at) {
  return Misfit(bundle, match, at.data() + 3 * match.a, at.data() + 3 * match.b,
                at.data() + bundle.Lens());
}

// Robust sd of a coordinate; weights by Cauchy's loss.
void ReweighBundle(Bundle& bundle, const AimVector& at) {
  std::vector<double> off;
  for (const BundleMatch& match : bundle.matches) {
    for (const double v : MisfitAt(bundle, match, at)) off.push_back(std::abs(v));
  }
  bundle.sd_px = std::max(1e-3, kAimMad * UpperMedian(off));
  for (BundleMatch& match : bundle.matches) {
    const auto [x, y] = MisfitAt(bundle, match, at);
    const double z = std::hypot(x, y) / (kAimCauchy * bundle.sd_px);
    match.weight = 1.0 / (1.0 + z * z);
  }
}

// What a lens and a sensor may do beside f, a and b, at the place (u, v) as a share of the rim:
// sides that differ or lean, Brown's decentring, and an axis that is not in the middle, less the
// turn that this looks like.
std::array<double, 2> ExtraBend(int term, double u, double v) {
  switch (term) {
    case 0:
      return {u, -v};
    case 1:
      return {v, u};
    case 2:
      return {3.0 * u * u + v * v, 2.0 * u * v};
    case 3:
      return {2.0 * u * v, u * u + 3.0 * v * v};
    case 4:
      return {u * u, u * v};
    default:
      return {u * v, v * v};
  }
}

// How the rows change with each term, in rims.
AimMatrix ExtraColumns(const Bundle& bundle, const AimVector& at) {
  constexpr double kStep = 1e-3;
  const double rim = RimPixels(bundle.view);
  const auto bent = [&](const std::array<double, 2>& point, int term) {
    const auto [x, y] = ExtraBend(term, (point[0] - bundle.view.width / 2.0) / rim,
                                  (bundle.view.height / 2.0 - point[1]) / rim);
    return std::array{point[0] + kStep * rim * x, point[1] - kStep * rim * y};
  };
  AimMatrix columns = AimMatrix::Zero(bundle.Rows(), kExtraBends);
  Eigen::Index row = 0;
  for (const BundleMatch& match : bundle.matches) {
    const auto before = MisfitAt(bundle, match, at);
    const double scale = std::sqrt(match.weight) / bundle.sd_px / kStep;
    for (int term = 0; term < kExtraBends; ++term) {
      BundleMatch moved = match;
      moved.at_a = bent(match.at_a, term);
      moved.at_b = bent(match.at_b, term);
      const auto after = MisfitAt(bundle, moved, at);
      columns(row, term) = scale * (after[0] - before[0]);
      columns(row + 1, term) = scale * (after[1] - before[1]);
    }
    row += 2;
  }
  return columns;
}

struct ExtraBends {
  AimVector mean;
  AimMatrix covariance;
};

// Their terms c given rows r = B c + errors of sd 1: normal about 0, all of one sd, which is the
// likeliest (expectation and maximisation), with one more term of kUnseenBend.
ExtraBends LikelyBends(const AimMatrix& columns, const AimVector& rows) {
  const AimMatrix normal = columns.transpose() * columns;
  const AimVector right = columns.transpose() * rows;
  const AimMatrix unit = AimMatrix::Identity(kExtraBends, kExtraBends);
  ExtraBends bends;
  double variance = 1e-6;
  for (int round = 0; round < kBendRounds; ++round) {
    bends.covariance = (normal + unit / variance).ldlt().solve(unit);
    bends.mean = bends.covariance * right;
    variance = (bends.mean.squaredNorm() + bends.covariance.trace() + kUnseenBend * kUnseenBend) /
               (kExtraBends + 1);
  }
  return bends;
}

// The matches of each field of 6 degrees, whose errors are taken to be one.
std::vector<std::vector<Eigen::Index>> FieldsOf(const Bundle& bundle, const AimVector& at) {
  std::map<std::pair<int, int>, std::vector<Eigen::Index>> fields;
  for (std::size_t i = 0; i < bundle.matches.size(); ++i) {
    const BundleMatch& match = bundle.matches[i];
    const auto d =
        Turned(bundle, match.a, match.at_a, at.data() + 3 * match.a, at.data() + bundle.Lens());
    const double height = std::asin(std::clamp(d[2], -1.0, 1.0));
    const std::pair field{
        static_cast<int>(std::floor(height / kField)),
        static_cast<int>(std::floor(std::atan2(d[0], d[1]) * std::cos(height) / kField))};
    fields[field].push_back(static_cast<Eigen::Index>(i));
  }
  std::vector<std::vector<Eigen::Index>> matches;
  for (auto& [field, of_it] : fields) matches.push_back(std::move(of_it));
  return matches;
}

// The second derivative of the matches' loss, Cauchy's:
//   J^T J - 2/c^2 sum (J^T r)(J^T r)^T.
AimMatrix CurvatureOf(const std::vector<Eigen::Index>& matches, const AimMatrix& jacobian,
                      const AimVector& residual) {
  const auto count = static_cast<Eigen::Index>(matches.size());
  AimMatrix rows(2 * count, jacobian.cols()), scores(jacobian.cols(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index row = 2 * matches[static_cast<std::size_t>(i)];
    rows.middleRows<2>(2 * i) = jacobian.middleRows<2>(row);
    scores.col(i) = jacobian.middleRows<2>(row).transpose() * residual.segment<2>(row);
  }
  return rows.transpose() * rows - 2.0 / (kAimCauchy * kAimCauchy) * (scores * scores.transpose());
}

// By how much leaving out one field after the other moves the parameters: the sum of squares. The
// scatter of few fields, of which some carry a view alone, is too small without (CR3).
// Source: Bell & McCaffrey, Survey Methodology 28 (2002) 169.
AimMatrix ScatterOfFields(const std::vector<std::vector<Eigen::Index>>& fields,
                          const AimMatrix& jacobian, const AimVector& residual,
                          const AimVector& rest, const AimMatrix& curvature) {
  AimMatrix scatter = AimMatrix::Zero(jacobian.cols(), jacobian.cols());
  for (const auto& field : fields) {
    const AimMatrix without = curvature - CurvatureOf(field, jacobian, residual);
    AimVector score = AimVector::Zero(jacobian.cols());
    for (const Eigen::Index match : field) {
      score += jacobian.middleRows<2>(2 * match).transpose() * rest.segment<2>(2 * match);
    }
    const AimVector moved = without.ldlt().solve(score);
    scatter += moved * moved.transpose();
  }
  return scatter;
}

// The covariance of all parameters about the truth.
AimMatrix CovarianceOfBundle(const Bundle& bundle, const AimVector& at) {
  const BundleRows rows{bundle};
  AimVector residual(rows.NumResiduals());
  AimMatrix jacobian(rows.NumResiduals(), rows.NumParameters());
  rows(at.data(), residual.data(), jacobian.data());
  const AimMatrix unit = AimMatrix::Identity(jacobian.cols(), jacobian.cols());

  const AimMatrix extra = ExtraColumns(bundle, at);
  // What a term of the lens moves the parameters by, and what it leaves in the rows beside that.
  const AimMatrix moved =
      (jacobian.transpose() * jacobian).ldlt().solve(jacobian.transpose() * extra);
  const AimMatrix left = extra - jacobian * moved;
  const ExtraBends bends = LikelyBends(left, residual);
  const AimMatrix bent = bends.mean * bends.mean.transpose() + bends.covariance;

  const auto fields = FieldsOf(bundle, at);
  const auto beside = jacobian.bottomRows(bundle.Rows() - 2 * bundle.matches.size());
  AimMatrix curvature = beside.transpose() * beside;
  curvature.diagonal().head(bundle.Lens()).array() += 1.0 / (kAimSd * kAimSd);
  for (const auto& field : fields) curvature += CurvatureOf(field, jacobian, residual);
  AimMatrix priors = AimMatrix::Zero(jacobian.cols(), jacobian.cols());
  for (int k = 0; k < kLensParameters; ++k) {
    const double sd = k == 0 ? bundle.ln_focal_sd : kBendSd;
    priors(bundle.Lens() + k, bundle.Lens() + k) = 1.0 / (sd * sd);
  }
  const AimMatrix inverse = curvature.ldlt().solve(unit);
  return ScatterOfFields(fields, jacobian, residual, residual - left * bends.mean, curvature) +
         inverse * priors * inverse.transpose() + moved * bent * moved.transpose();
}

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
    view.field_of_view = Radians(degrees * kDegree);
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

Bundle BundleOf(const AimQuestion& question, const ViewTree& tree) {
  Bundle bundle;
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
      BundleMatch match;
      match.a = edge.pair.a;
      match.b = edge.pair.b;
      match.at_a = point(question.features[match.a][a]);
      match.at_b = point(question.features[match.b][b]);
      bundle.matches.push_back(match);
    }
  }
  return bundle;
}

// The turns become part of the views' own.
void FoldTurns(Bundle& bundle, AimVector& at) {
  for (std::size_t v = 0; v < bundle.turns.size(); ++v) {
    double* const turn = at.data() + 3 * v;
    Eigen::Matrix3d& own = bundle.turns[v];
    for (Eigen::Index column = 0; column < 3; ++column) {
      const Vec3 image = TurnedBy(turn, Vec3{own(0, column), own(1, column), own(2, column)});
      own.col(column) << image[0], image[1], image[2];
    }
    std::fill_n(turn, 3, 0.0);
  }
}

AimVector SolveBundle(Bundle& bundle, const ViewOptics& start) {
  AimVector at = AimVector::Zero(bundle.Size());
  at.tail<kLensParameters>() << std::log(start.focal_px), start.lens.a, start.lens.b;
  for (int round = 0; round < kBundleRounds; ++round) {
    SetTangents(bundle, at);
    ReweighBundle(bundle, at);
    ceres::TinySolver<BundleRows> solver;
    solver.options.max_num_iterations = 12;
    solver.options.initial_trust_region_radius = 1e8;
    solver.options.function_tolerance = 1e-9;
    const BundleRows rows{bundle};
    solver.Solve(rows, &at);
    FoldTurns(bundle, at);
  }
  SetTangents(bundle, at);
  ReweighBundle(bundle, at);
  return at;
}

SolvedAims AimsOf(const Bundle& bundle, const AimVector& at) {
  const AimMatrix covariance = CovarianceOfBundle(bundle, at);
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
    aims.u95_deg.push_back(Length95(own) / kDegree);
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
  Bundle bundle;
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
