// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/merged_rows.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <vector>

#include "lightcal/fit/model/hypotheses.h"

namespace lightcal::fit {
namespace {

constexpr double kStretch = 1.2;  // farthest over nearest

bool MayMerge(const ReadingRow& row) {
  return row.form == RowForm::kLog && row.direct_gain > 0.0 && !row.off_axis && !row.by_aim &&
         !row.data_sheet;
}

auto KindOf(const ReadingRow& row) {
  return std::tuple(row.walls.has_value(), row.direct_gain, row.bounce, row.ambient_gain,
                    row.scale);
}

double WeightOf(const ReadingRow& row) { return 1.0 / (row.own_sigma * row.own_sigma); }

// A row that may be merged, and its logarithms, which several sums need.
struct Mergeable {
  const ReadingRow* row = nullptr;
  double ln_distance = 0.0, ln_measured = 0.0;
};

struct OneRow {
  ReadingRow row;
  MergedRows::Spread spread;
};

// The rows of one place, which the walls' light scatters alike.
struct PlaceMean {
  int place = 0;
  double weight = 0.0, ln_distance = 0.0, ln_moved = 0.0;

  void Add(double more, double at, double moved) {
    weight += more;
    ln_distance += (at - ln_distance) * more / weight;
    ln_moved += (moved - ln_moved) * more / weight;
  }
};

// Weighted means; rows of equal sigmas keep the variance that their mean has.
OneRow MergeStretch(std::span<const Mergeable> rows) {
  if (rows.size() == 1) return {*rows.front().row, {}};
  double weights = 0.0;
  double ln_distance = 0.0;
  WallsOfRow walls;
  double scatter = 0.0;
  double uneven = 0.0;
  for (const auto& [row, at, read] : rows) {
    const double weight = WeightOf(*row);
    weights += weight;
    ln_distance += weight * at;
    uneven += weight * weight * row->uneven * row->uneven;
    if (!row->walls) continue;
    walls.x += weight * row->walls->x;
    walls.constant += weight * row->walls->constant;
    scatter += weight * weight * row->walls->scatter * row->walls->scatter;
  }
  ln_distance /= weights;
  std::vector<PlaceMean> places;
  double ln_measured = 0.0;
  for (const auto& [row, at, read] : rows) {
    const double weight = WeightOf(*row);
    const double moved = read + 2.0 * (at - ln_distance);
    ln_measured += weight * moved / weights;
    const int place = row->walls ? row->walls->place : static_cast<int>(places.size());
    if (places.empty() || places.back().place != place) places.push_back({place});
    places.back().Add(weight, at, moved);
  }
  OneRow out{*rows.front().row, {static_cast<int>(places.size()) - 1, 0.0}};
  // About a line: light from walls and offset turn them from the inverse square law.
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const PlaceMean& one : places) {
    const double x = one.ln_distance - ln_distance;
    const double y = one.ln_moved - ln_measured;
    xx += one.weight * x * x;
    xy += one.weight * x * y;
    yy += one.weight * y * y;
  }
  out.spread.squares = xx > 0.0 ? std::max(0.0, yy - xy * xy / xx) : yy;
  out.row.distance = std::exp(ln_distance);
  out.row.measured = std::exp(ln_measured);
  out.row.own_sigma = 1.0 / std::sqrt(weights);
  out.row.uneven = std::sqrt(uneven) / weights;
  out.row.sigma = std::hypot(out.row.own_sigma, out.row.uneven);
  if (out.row.walls) {
    out.row.walls = {walls.x / weights, walls.constant / weights, std::sqrt(scatter) / weights};
  }
  return out;
}

}  // namespace

std::optional<MergedRows> Merge(const Estimation& estimation) {
  std::vector<Mergeable> alike;
  MergedRows out;
  for (const ReadingRow& row : estimation.rows) {
    if (MayMerge(row)) {
      alike.push_back({&row, std::log(row.distance), std::log(row.measured)});
    } else {
      out.estimation.rows.push_back(row);
    }
  }
  out.spreads.resize(out.estimation.rows.size());
  std::ranges::sort(alike, [](const Mergeable& a, const Mergeable& b) {
    return std::tuple(KindOf(*a.row), a.row->distance) <
           std::tuple(KindOf(*b.row), b.row->distance);
  });
  for (auto first = alike.begin(); first != alike.end();) {
    const ReadingRow& nearest = *first->row;
    const auto last = std::find_if(first, alike.end(), [&nearest](const Mergeable& one) {
      return KindOf(*one.row) != KindOf(nearest) || one.row->distance > kStretch * nearest.distance;
    });
    const OneRow one = MergeStretch({first, last});
    out.estimation.rows.push_back(one.row);
    out.spreads.push_back(one.spread);
    first = last;
  }
  if (2 * out.spreads.size() >= estimation.rows.size()) return std::nullopt;
  out.estimation.rules = estimation.rules;
  out.estimation.least_distance_offset = estimation.least_distance_offset;
  out.estimation.choice = estimation.choice;
  return out;
}

double LnEvidence(const MergedRows& merged, const Theta& theta) {
  double ln = LnEvidence(merged.estimation, theta);
  for (std::size_t i = 0; i < merged.spreads.size(); ++i) {
    const MergedRows::Spread& spread = merged.spreads[i];
    if (spread.more == 0) continue;
    const ReadingRow& row = merged.estimation.rows[i];
    const double part = row.own_sigma / row.sigma;
    ln -= 0.5 * spread.squares * part * part + spread.more * std::log(row.sigma);
  }
  return ln;
}

}  // namespace lightcal::fit
