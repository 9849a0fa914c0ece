// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/view_tree.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lightcal/core/units.h"

namespace lightcal {
namespace {

constexpr double kFitsTree = 4.0 * kRadiansPerDegree;

Eigen::Matrix3d MatrixOf(const CameraAxes& rows) {
  Eigen::Matrix3d m;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Vec3& row = rows[static_cast<std::size_t>(i)];
    m.row(i) << row[0], row[1], row[2];
  }
  return m;
}

// The views reached from `root`, rotations filled in, always over the pair with most matches.
std::vector<bool> GrowTree(std::size_t root, const std::vector<TurnedPair>& sorted,
                           std::vector<Eigen::Matrix3d>& turns) {
  std::vector<bool> reached(turns.size(), false);
  reached[root] = true;
  turns[root] = Eigen::Matrix3d::Identity();
  for (bool grown = true; grown;) {
    grown = false;
    for (const TurnedPair& edge : sorted) {
      const auto [a, b] = std::pair(edge.pair.a, edge.pair.b);
      if (reached[a] == reached[b]) continue;
      const Eigen::Matrix3d a_from_b = MatrixOf(edge.a_from_b);
      if (reached[a]) {
        turns[b] = a_from_b.transpose() * turns[a];
      } else {
        turns[a] = a_from_b * turns[b];
      }
      reached[a] = reached[b] = grown = true;
      break;
    }
  }
  return reached;
}

}  // namespace

Result<ViewTree> TreeOfViews(std::span<const std::string> names, std::vector<TurnedPair> pairs) {
  std::ranges::stable_sort(pairs, [](const TurnedPair& x, const TurnedPair& y) {
    return x.pair.matches.size() > y.pair.matches.size();
  });
  ViewTree tree;
  std::vector<Eigen::Matrix3d> best;
  std::vector<bool> reached;
  for (std::size_t root = 0; root < names.size(); ++root) {
    if (!reached.empty() && reached[root]) continue;
    std::vector<Eigen::Matrix3d> turns(names.size(), Eigen::Matrix3d::Identity());
    auto from_root = GrowTree(root, pairs, turns);
    if (reached.empty() ||
        std::ranges::count(from_root, true) > std::ranges::count(reached, true)) {
      reached = std::move(from_root);
      best = std::move(turns);
    }
  }
  const auto lone = std::ranges::find(reached, false);
  if (lone != reached.end()) {
    const auto count = std::ranges::count(reached, true);
    return Refused("views_do_not_overlap", names[static_cast<std::size_t>(lone - reached.begin())],
                   "it shares too little with the other views to find where it looked (" +
                       std::to_string(count) + " of " + std::to_string(names.size()) +
                       " views hang together); views overlap by a third and more where things "
                       "have detail: take one between, leave it out, or give {view.aims} of all");
  }
  for (TurnedPair& edge : pairs) {
    const Eigen::Matrix3d expected = best[edge.pair.a] * best[edge.pair.b].transpose();
    const double cosine = ((expected.transpose() * MatrixOf(edge.a_from_b)).trace() - 1.0) / 2.0;
    if (cosine > std::cos(kFitsTree)) tree.pairs.push_back(std::move(edge));
  }
  for (const Eigen::Matrix3d& turn : best) {
    CameraAxes axes{};
    for (Eigen::Index i = 0; i < 3; ++i) {
      axes[static_cast<std::size_t>(i)] = {turn(i, 0), turn(i, 1), turn(i, 2)};
    }
    tree.axes.push_back(axes);
  }
  return tree;
}

}  // namespace lightcal
