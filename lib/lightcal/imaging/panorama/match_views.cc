// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/match_views.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>

#include "lightcal/core/parallel.h"

namespace lightcal {
namespace {

constexpr double kNearerThanNext = 0.8;     // ratio of distances
constexpr std::size_t kAllAgainstAll = 10;  // views
constexpr std::size_t kNeighbours = 10;     // of a view among more
constexpr std::size_t kStrongest = 250;     // features that choose them
constexpr int kDraws = 400;
constexpr double kSame = 1e-4;  // radians: two matches that are one draw nothing

using Descriptors = Eigen::Matrix<float, Eigen::Dynamic, 128, Eigen::RowMajor>;

Descriptors DescriptorsOf(const std::vector<PictureFeature>& features, std::size_t most) {
  const std::size_t count = std::min(most, features.size());
  Descriptors rows(static_cast<Eigen::Index>(count), 128);
  for (std::size_t i = 0; i < count; ++i) {
    rows.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::Matrix<float, 1, 128>>(features[i].descriptor.data());
  }
  return rows;
}

// The column of each row's largest value, absent where another is nearly as large.
std::vector<std::optional<Eigen::Index>> ClearlyNearest(const Eigen::MatrixXf& alike) {
  std::vector<std::optional<Eigen::Index>> out(static_cast<std::size_t>(alike.cols()));
  for (Eigen::Index column = 0; column < alike.cols(); ++column) {
    float best = -1.0F, next = -1.0F;
    Eigen::Index at = 0;
    for (Eigen::Index row = 0; row < alike.rows(); ++row) {
      const float value = alike(row, column);
      if (value > best) {
        next = best;
        best = value;
        at = row;
      } else {
        next = std::max(next, value);
      }
    }
    const double near2 = 2.0 - 2.0 * double{best}, next2 = 2.0 - 2.0 * double{next};
    if (near2 < kNearerThanNext * kNearerThanNext * next2) {
      out[static_cast<std::size_t>(column)] = at;
    }
  }
  return out;
}

std::vector<std::pair<std::size_t, std::size_t>> Mutual(const Descriptors& a,
                                                        const Descriptors& b) {
  std::vector<std::pair<std::size_t, std::size_t>> matches;
  if (a.rows() < 2 || b.rows() < 2) return matches;
  const Eigen::MatrixXf alike = a * b.transpose();
  const auto of_b = ClearlyNearest(alike);
  const auto of_a = ClearlyNearest(alike.transpose());
  for (std::size_t j = 0; j < of_b.size(); ++j) {
    if (!of_b[j]) continue;
    const auto i = static_cast<std::size_t>(*of_b[j]);
    if (of_a[i] == static_cast<Eigen::Index>(j)) matches.emplace_back(i, j);
  }
  return matches;
}

std::vector<ViewPair> EveryPair(std::span<const Descriptors> rows) {
  std::vector<ViewPair> pairs;
  for (std::size_t a = 0; a < rows.size(); ++a) {
    for (std::size_t b = a + 1; b < rows.size(); ++b) pairs.push_back({a, b, {}});
  }
  ParallelFor(static_cast<int>(pairs.size()), [&](int i) {
    ViewPair& pair = pairs[static_cast<std::size_t>(i)];
    pair.matches = Mutual(rows[pair.a], rows[pair.b]);
  });
  return pairs;
}

// The pairs that are among the best of one of their two.
std::vector<ViewPair> BestPairs(const std::vector<ViewPair>& pairs, std::size_t views) {
  std::vector<bool> taken(pairs.size(), false);
  for (std::size_t v = 0; v < views; ++v) {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (pairs[i].a == v || pairs[i].b == v) own.push_back(i);
    }
    std::ranges::stable_sort(own, [&](std::size_t a, std::size_t b) {
      return pairs[a].matches.size() > pairs[b].matches.size();
    });
    for (std::size_t k = 0; k < std::min(kNeighbours, own.size()); ++k) taken[own[k]] = true;
  }
  std::vector<ViewPair> out;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (taken[i]) out.push_back({pairs[i].a, pairs[i].b, {}});
  }
  return out;
}

Eigen::Vector3d BearingAt(const ViewOptics& optics, const PictureFeature& feature) {
  const Vec3 v = BearingOf(optics.view, {double{feature.x}, double{feature.y}}, optics.focal_px,
                           optics.lens.a, optics.lens.b);
  return {v[0], v[1], v[2]};
}

// The rotation that brings columns of b nearest to those of a.
Eigen::Matrix3d Kabsch(const Eigen::Matrix3d& sum_a_bt) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum_a_bt, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign(1.0, 1.0, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

struct BearingPairs {
  Eigen::Matrix3Xd a, b;
  double tolerance = 0.0;

  [[nodiscard]] std::vector<Eigen::Index> Agreeing(const Eigen::Matrix3d& a_from_b) const {
    std::vector<Eigen::Index> out;
    for (Eigen::Index i = 0; i < a.cols(); ++i) {
      if ((a.col(i) - a_from_b * b.col(i)).norm() < tolerance) out.push_back(i);
    }
    return out;
  }
  [[nodiscard]] Eigen::Matrix3d Fit(const std::vector<Eigen::Index>& chosen) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Eigen::Index i : chosen) sum += a.col(i) * b.col(i).transpose();
    return Kabsch(sum);
  }
};

}  // namespace

std::vector<ViewPair> MatchViews(std::span<const std::vector<PictureFeature>> features) {
  std::vector<Descriptors> rows;
  const bool all = features.size() <= kAllAgainstAll;
  for (const auto& of_view : features) {
    rows.push_back(DescriptorsOf(of_view, all ? of_view.size() : kStrongest));
  }
  std::vector<ViewPair> pairs = EveryPair(rows);
  if (all) return pairs;
  pairs = BestPairs(pairs, features.size());
  for (std::size_t v = 0; v < features.size(); ++v) {
    rows[v] = DescriptorsOf(features[v], features[v].size());
  }
  ParallelFor(static_cast<int>(pairs.size()), [&](int i) {
    ViewPair& pair = pairs[static_cast<std::size_t>(i)];
    pair.matches = Mutual(rows[pair.a], rows[pair.b]);
  });
  return pairs;
}

TurnedPair TurnOfPair(const ViewPair& pair, std::span<const std::vector<PictureFeature>> features,
                      const ViewOptics& optics, double tolerance_px) {
  TurnedPair best{{pair.a, pair.b, {}}, {}};
  const auto count = static_cast<Eigen::Index>(pair.matches.size());
  if (count < 2) return best;
  BearingPairs bearings{Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count),
                        tolerance_px / optics.focal_px};
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [of_a, of_b] = pair.matches[static_cast<std::size_t>(i)];
    bearings.a.col(i) = BearingAt(optics, features[pair.a][of_a]);
    bearings.b.col(i) = BearingAt(optics, features[pair.b][of_b]);
  }
  std::mt19937 random(static_cast<std::mt19937::result_type>(1 + pair.a * 1009 + pair.b));
  std::vector<Eigen::Index> agreeing;
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto i = static_cast<Eigen::Index>(random() % static_cast<std::size_t>(count));
    const auto j = static_cast<Eigen::Index>(random() % static_cast<std::size_t>(count));
    const double apart = (bearings.a.col(i) - bearings.a.col(j)).norm();
    const double apart_b = (bearings.b.col(i) - bearings.b.col(j)).norm();
    if (apart < kSame + bearings.tolerance ||
        std::abs(apart - apart_b) > 2.0 * bearings.tolerance) {
      continue;
    }
    auto found = bearings.Agreeing(bearings.Fit({i, j}));
    if (found.size() > agreeing.size()) agreeing = std::move(found);
  }
  if (agreeing.size() < 2) return best;
  Eigen::Matrix3d turn = bearings.Fit(agreeing);
  for (int round = 0; round < 3; ++round) {
    auto found = bearings.Agreeing(turn);
    if (found.size() < agreeing.size()) break;
    agreeing = std::move(found);
    turn = bearings.Fit(agreeing);
  }
  for (const Eigen::Index i : agreeing) {
    best.pair.matches.push_back(pair.matches[static_cast<std::size_t>(i)]);
  }
  for (Eigen::Index r = 0; r < 3; ++r) {
    best.a_from_b[static_cast<std::size_t>(r)] = {turn(r, 0), turn(r, 1), turn(r, 2)};
  }
  return best;
}

bool BelongTogether(std::size_t agreeing, std::size_t matches) {
  constexpr double kLeast = 6.0, kShare = 0.22;
  return static_cast<double>(agreeing) > kLeast + kShare * static_cast<double>(matches);
}

}  // namespace lightcal
