// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/view_scales.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "lightcal/core/statistics.h"
#include "lightcal/imaging/panorama/overlap_cells.h"

namespace lightcal {
namespace {

constexpr int kBlock = 6;             // cells on the side of a block of common errors
constexpr double kLeastCells = 12.0;  // that join a view to the others, as cells of the equator
constexpr double kFalloffSd = 0.7;    // prior of its coefficients: half the light at the rim
constexpr double kMirrorSd = 0.05;    // the same of a mirror ball, whose reflectance is taken off
// What sampling between the pixels of gradients leaves in a view's factor, measured on synthetic
// skies: 1e-4 round a ring of views, however many pixels they share.
constexpr double kSamplingSd = 1.5e-4;
constexpr int kSolveRounds = 25;
constexpr double kGaugeWeight = 1e9;

// Two views of one cell, which say one luminance.
struct Pair {
  std::size_t a = 0, b = 0, block = 0;
  double ln = 0.0;                 // of a over b
  double sd = 0.0;                 // of ln, by the scatter in the cell
  std::array<double, 3> radius{};  // r^2 r^4 r^6, a's less b's
  double area = 0.0;               // of the cell, of one on the equator
  double full = 0.0;               // weight without doubt
  double weight = 0.0;
};

// With weights w of a cell's sights, sum w (x - mean)^2 = sum over its pairs of w_a w_b / W (x_a -
// x_b)^2: doubt can so be cast on what two views say of each other. Cast on single sights against
// their mean it falls on either of two, the mean follows the other, and half of all sights agree
// with it whatever the pictures show.
void AddPairs(const std::vector<OverlapView>& cell, int x, int y, std::vector<Pair>& pairs) {
  const double area = OverlapCellArea(y);
  double all = 0.0;
  for (const OverlapView& view : cell) {
    if (view.sight) all += area / view.sight->variance;
  }
  const auto block = static_cast<std::size_t>(y / kBlock * (kOverlapColumns / kBlock) + x / kBlock);
  for (std::size_t i = 0; i < cell.size(); ++i) {
    for (std::size_t j = i + 1; cell[i].sight && j < cell.size(); ++j) {
      if (!cell[j].sight) continue;
      const OverlapSight &a = *cell[i].sight, &b = *cell[j].sight;
      Pair pair{i, j, block, a.ln - b.ln, std::sqrt(a.variance + b.variance), {}, area, 0.0, 0.0};
      for (std::size_t k = 0; k < 3; ++k) pair.radius[k] = a.radius[k] - b.radius[k];
      pair.weight = pair.full = area * area / (a.variance * b.variance) / all;
      pairs.push_back(pair);
    }
  }
}

std::vector<Pair> PairsOf(const std::vector<std::vector<OverlapView>>& cells) {
  std::vector<Pair> pairs;
  for (int y = 0; y < kOverlapRows; ++y) {
    for (int x = 0; x < kOverlapColumns; ++x) {
      AddPairs(cells[static_cast<std::size_t>(y * kOverlapColumns + x)], x, y, pairs);
    }
  }
  return pairs;
}

// Every view must hang together with the first over enough cells.
Result<void> CheckOverlap(std::span<const AimedPicture> views, const std::vector<Pair>& pairs) {
  std::map<std::pair<std::size_t, std::size_t>, double> shared;
  for (const Pair& pair : pairs) {
    shared[{pair.a, pair.b}] += pair.area;
    shared[{pair.b, pair.a}] += pair.area;
  }
  std::vector<bool> joined(views.size(), false);
  joined[0] = true;
  for (std::size_t round = 1; round < views.size(); ++round) {
    for (const auto& [pair, area] : shared) {
      if (joined[pair.first] && area >= kLeastCells) joined[pair.second] = true;
    }
  }
  const auto lone = std::ranges::find(joined, false);
  if (lone == joined.end()) return {};
  return Refused("views_do_not_overlap",
                 views[static_cast<std::size_t>(lone - joined.begin())].name,
                 "no other view shows enough of what this one does, lit and unclipped, to give it "
                 "their scale; check its aim and field of view, or take a view between");
}

// Normal equations: unknowns are -ln f of every view, then the fall-off.
class Normal {
 public:
  Normal(std::size_t views, const std::vector<bool>& in_gauge, double falloff_sd)
      : falloff_sd_(falloff_sd),
        size_(static_cast<Eigen::Index>(views) + 3),
        views_(static_cast<Eigen::Index>(views)) {
    gauge_ = Eigen::VectorXd::Zero(size_);
    for (Eigen::Index i = 0; i < views_; ++i) {
      gauge_[i] = in_gauge.empty() || in_gauge[static_cast<std::size_t>(i)] ? 1.0 : 0.0;
    }
    gauge_.normalize();
    unknowns_ = Eigen::VectorXd::Zero(size_);
  }

  // What the two say of each other beyond their scales and the lens.
  [[nodiscard]] double Left(const Pair& pair) const {
    double left = pair.ln;
    for (const auto& [at, slope] : RowOf(pair)) left -= slope * unknowns_[at];
    return left;
  }

  void Solve(const std::vector<Pair>& pairs) {
    matrix_ = kGaugeWeight * gauge_ * gauge_.transpose();
    for (Eigen::Index k = views_; k < size_; ++k) {
      matrix_(k, k) += 1.0 / (falloff_sd_ * falloff_sd_);
    }
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size_);
    for (const Pair& pair : pairs) {
      const Row row = RowOf(pair);
      for (const auto& [i, slope] : row) {
        right[i] += pair.weight * pair.ln * slope;
        for (const auto& [j, other] : row) matrix_(i, j) += pair.weight * slope * other;
      }
    }
    unknowns_ = matrix_.ldlt().solve(right);
  }

  [[nodiscard]] Eigen::MatrixXd Covariance(const std::vector<Pair>& pairs) const {
    std::map<std::size_t, Eigen::VectorXd> scores;
    for (const Pair& pair : pairs) {
      auto& score = scores.try_emplace(pair.block, Eigen::VectorXd::Zero(size_)).first->second;
      const double left = Left(pair);
      for (const auto& [i, slope] : RowOf(pair)) score[i] += pair.weight * left * slope;
    }
    Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(size_, size_);
    for (const auto& [block, score] : scores) middle += score * score.transpose();
    const Eigen::MatrixXd inverse = matrix_.ldlt().solve(Eigen::MatrixXd::Identity(size_, size_));
    return inverse * middle * inverse.transpose();
  }

  [[nodiscard]] const Eigen::VectorXd& unknowns() const { return unknowns_; }

 private:
  using Row = std::array<std::pair<Eigen::Index, double>, 5>;

  [[nodiscard]] Row RowOf(const Pair& pair) const {
    return {{{static_cast<Eigen::Index>(pair.a), 1.0},
             {static_cast<Eigen::Index>(pair.b), -1.0},
             {views_, pair.radius[0]},
             {views_ + 1, pair.radius[1]},
             {views_ + 2, pair.radius[2]}}};
  }

  double falloff_sd_;
  Eigen::Index size_, views_;
  Eigen::VectorXd gauge_, unknowns_;
  Eigen::MatrixXd matrix_;
};

// Robust sd of what two views leave: in units of its own sd, or of ln L of one.
double SdOfRest(const Normal& normal, const std::vector<Pair>& pairs, bool in_own_sd) {
  std::vector<double> off;
  off.reserve(pairs.size());
  for (const Pair& pair : pairs) {
    off.push_back(std::abs(normal.Left(pair)) / (in_own_sd ? pair.sd : std::numbers::sqrt2));
  }
  return kSdPerMad * UpperMedian(off);
}

void Reweigh(const Normal& normal, std::vector<Pair>& pairs) {
  const double sd = std::max(1e-6, SdOfRest(normal, pairs, true));
  for (Pair& pair : pairs) {
    const double off = normal.Left(pair) / pair.sd / (kCauchyScale * sd);
    pair.weight = pair.full / (1.0 + off * off);
  }
}

// As OverlapsOf asks for it.
std::vector<std::vector<double>> OnOneScale(const std::vector<std::vector<OverlapView>>& cells,
                                            const ViewScales& scales) {
  constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::vector<double>> values(scales.factor.size(),
                                          std::vector<double>(cells.size(), kUnseen));
  for (std::size_t at = 0; at < cells.size(); ++at) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const OverlapView& view = cells[at][i];
      if (view.clipped) values[i][at] = std::numeric_limits<double>::infinity();
      if (!view.sight) continue;
      double ln = view.sight->ln + std::log(scales.factor[i]);
      for (std::size_t k = 0; k < 3; ++k) ln -= scales.falloff[k] * view.sight->radius[k];
      values[i][at] = ln;
    }
  }
  return values;
}

}  // namespace

double ViewScales::Falloff(double rim_share) const {
  const double r2 = rim_share * rim_share;
  return std::exp(r2 * (falloff[0] + r2 * (falloff[1] + r2 * falloff[2])));
}

Result<ViewScales> SolveViewScales(std::span<const AimedPicture> views,
                                   const std::vector<bool>& in_gauge) {
  ViewScales scales;
  if (views.size() < 2) {
    scales.factor.assign(views.size(), 1.0);
    scales.sd_relative.assign(views.size(), 0.0);
    return scales;
  }
  const auto cells = OverlapSights(views);
  std::vector<Pair> pairs = PairsOf(cells);
  if (auto ok = CheckOverlap(views, pairs); !ok) return Propagate(std::move(ok));
  const bool balls = std::ranges::any_of(
      views, [](const AimedPicture& picture) { return picture.view.ball().has_value(); });
  Normal normal(views.size(), in_gauge, balls ? kMirrorSd : kFalloffSd);
  for (int round = 0; round < kSolveRounds; ++round) {
    normal.Solve(pairs);
    Reweigh(normal, pairs);
  }
  const Eigen::MatrixXd covariance = normal.Covariance(pairs);
  const auto count = static_cast<Eigen::Index>(views.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    scales.factor.push_back(std::exp(-normal.unknowns()[i]));
    scales.sd_relative.push_back(
        std::sqrt(std::max(0.0, covariance(i, i)) + kSamplingSd * kSamplingSd));
  }
  for (Eigen::Index k = 0; k < 3; ++k) {
    scales.falloff[static_cast<std::size_t>(k)] = normal.unknowns()[count + k];
  }
  scales.agreement_sd = SdOfRest(normal, pairs, false);
  scales.overlaps = OverlapsOf(OnOneScale(cells, scales));
  return scales;
}

}  // namespace lightcal
