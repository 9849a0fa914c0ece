// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/view_scales.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "lightcal/core/parallel.h"
#include "lightcal/core/statistics.h"
#include "lightcal/imaging/panorama/latlong_grid.h"

namespace lightcal {
namespace {

constexpr int kOverlapRows = 90, kCellColumns = 180;  // cells of 2 degrees
constexpr int kCellSide = 4;                          // kCellSide x kCellSide points of a cell
constexpr int kBlock = 6;             // cells on the side of a block of common errors
constexpr double kLeastCells = 12.0;  // that join a view to the others, as cells of the equator
constexpr double kLeastSd = 0.005;    // of a cell: edges, reflections, resampling
constexpr double kFalloffSd = 0.7;    // prior of its coefficients: half the light at the rim
constexpr double kMirrorSd = 0.05;    // the same of a mirror ball, whose reflectance is taken off
// What sampling between the pixels of gradients leaves in a view's factor, measured on synthetic
// skies: 1e-4 round a ring of views, however many pixels they share.
constexpr double kSamplingSd = 1.5e-4;
constexpr int kSolveRounds = 25;
constexpr double kGaugeWeight = 1e9;

// What one view says of one cell.
struct Sight {
  std::size_t view = 0;
  double ln = 0.0, variance = 0.0;
  std::array<double, 3> radius{};  // r^2 r^4 r^6
  double weight = 0.0;
};
struct Cell {
  std::size_t block = 0;
  double area = 1.0;  // of a cell on the equator
  std::vector<Sight> sights;
};

std::optional<Sight> SightOf(const AimedPicture& picture, std::size_t view, int x, int y) {
  double sum = 0.0, sum2 = 0.0, radius2 = 0.0;
  for (int i = 0; i < kCellSide * kCellSide; ++i) {
    const double azimuth =
        2.0 * std::numbers::pi * (x + (i % kCellSide + 0.5) / kCellSide) / kCellColumns;
    const double zenith = std::numbers::pi * (y + (i / kCellSide + 0.5) / kCellSide) / kOverlapRows;
    const auto seen = picture.view.See({-std::sin(azimuth) * std::sin(zenith),
                                        -std::cos(azimuth) * std::sin(zenith), std::cos(zenith)});
    if (!seen || seen->worth < 1.0) return std::nullopt;
    const PictureTap tap = TapAt(picture.view.angles().view(), seen->point);
    if (AnyClipped(picture, tap)) return std::nullopt;
    double value = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      value += double{tap.weight[k] * picture.nits.data()[tap.pixel[k]]} / seen->passed;
    }
    sum += value;
    sum2 += value * value;
    radius2 += seen->rim_share * seen->rim_share / (kCellSide * kCellSide);
  }
  const double count = kCellSide * kCellSide, mean = sum / count;
  if (!(mean > 0.0)) return std::nullopt;
  const double scatter2 = std::max(0.0, sum2 / count - mean * mean) / (mean * mean) / count;
  Sight sight{view, std::log(mean), scatter2 + kLeastSd * kLeastSd, {}, 0.0};
  sight.radius = {radius2, radius2 * radius2, radius2 * radius2 * radius2};
  return sight;
}

std::vector<Cell> SharedCells(std::span<const AimedPicture> views) {
  const LatLongGrid grid(kCellColumns, kOverlapRows);
  std::vector<std::vector<Cell>> rows(kOverlapRows);
  ParallelFor(kOverlapRows, [&](int y) {
    for (int x = 0; x < kCellColumns; ++x) {
      Cell cell;
      cell.block = static_cast<std::size_t>(y / kBlock * (kCellColumns / kBlock) + x / kBlock);
      cell.area = grid.SolidAngle(y) / grid.SolidAngle(kOverlapRows / 2);
      for (std::size_t i = 0; i < views.size(); ++i) {
        if (auto sight = SightOf(views[i], i, x, y)) cell.sights.push_back(*sight);
      }
      if (cell.sights.size() >= 2) rows[static_cast<std::size_t>(y)].push_back(std::move(cell));
    }
  });
  std::vector<Cell> cells;
  for (auto& row : rows) std::ranges::move(row, std::back_inserter(cells));
  return cells;
}

// Every view must hang together with the first over enough cells.
Result<void> CheckOverlap(std::span<const AimedPicture> views, const std::vector<Cell>& cells) {
  std::map<std::pair<std::size_t, std::size_t>, double> shared;
  for (const Cell& cell : cells) {
    for (const Sight& a : cell.sights) {
      for (const Sight& b : cell.sights) shared[{a.view, b.view}] += cell.area;
    }
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

  [[nodiscard]] Eigen::VectorXd RowOf(const Sight& sight) const {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(size_);
    row[static_cast<Eigen::Index>(sight.view)] = 1.0;
    for (Eigen::Index k = 0; k < 3; ++k)
      row[views_ + k] = sight.radius[static_cast<std::size_t>(k)];
    return row;
  }
  [[nodiscard]] double Left(const Sight& sight) const {
    double predicted = unknowns_[static_cast<Eigen::Index>(sight.view)];
    for (Eigen::Index k = 0; k < 3; ++k) {
      predicted += unknowns_[views_ + k] * sight.radius[static_cast<std::size_t>(k)];
    }
    return sight.ln - predicted;
  }
  // What a cell's views say above their weighted mean.
  [[nodiscard]] double MeanLeft(const Cell& cell) const {
    double sum = 0.0, weight = 0.0;
    for (const Sight& sight : cell.sights) {
      sum += sight.weight * Left(sight);
      weight += sight.weight;
    }
    return sum / weight;
  }

  void Solve(const std::vector<Cell>& cells) {
    matrix_ = kGaugeWeight * gauge_ * gauge_.transpose();
    for (Eigen::Index k = views_; k < size_; ++k) {
      matrix_(k, k) += 1.0 / (falloff_sd_ * falloff_sd_);
    }
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size_);
    for (const Cell& cell : cells) {
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(size_);
      double weight = 0.0, value = 0.0;
      for (const Sight& sight : cell.sights) {
        const Eigen::VectorXd row = RowOf(sight);
        matrix_ += sight.weight * row * row.transpose();
        right += sight.weight * sight.ln * row;
        sum += sight.weight * row;
        weight += sight.weight;
        value += sight.weight * sight.ln;
      }
      matrix_ -= sum * sum.transpose() / weight;
      right -= sum * (value / weight);
    }
    unknowns_ = matrix_.ldlt().solve(right);
  }

  [[nodiscard]] Eigen::MatrixXd Covariance(const std::vector<Cell>& cells) const {
    std::map<std::size_t, Eigen::VectorXd> scores;
    for (const Cell& cell : cells) {
      const double mean = MeanLeft(cell);
      auto& score = scores.try_emplace(cell.block, Eigen::VectorXd::Zero(size_)).first->second;
      for (const Sight& sight : cell.sights) {
        score += sight.weight * (Left(sight) - mean) * RowOf(sight);
      }
    }
    Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(size_, size_);
    for (const auto& [block, score] : scores) middle += score * score.transpose();
    const Eigen::MatrixXd inverse = matrix_.ldlt().solve(Eigen::MatrixXd::Identity(size_, size_));
    return inverse * middle * inverse.transpose();
  }

  [[nodiscard]] const Eigen::VectorXd& unknowns() const { return unknowns_; }

 private:
  double falloff_sd_;
  Eigen::Index size_, views_;
  Eigen::VectorXd gauge_, unknowns_;
  Eigen::MatrixXd matrix_;
};

// Robust sd of what is left: in units of the sights' own sd, or of ln L.
double SdOfRest(const Normal& normal, const std::vector<Cell>& cells, bool in_own_sd) {
  std::vector<double> off;
  for (const Cell& cell : cells) {
    const double mean = normal.MeanLeft(cell);
    for (const Sight& sight : cell.sights) {
      const double unit = in_own_sd ? std::sqrt(sight.variance) : 1.0;
      off.push_back(std::abs(normal.Left(sight) - mean) / unit);
    }
  }
  return kSdPerMad * UpperMedian(off);
}

void Reweigh(const Normal& normal, std::vector<Cell>& cells) {
  const double sd = std::max(1e-6, SdOfRest(normal, cells, true));
  for (Cell& cell : cells) {
    const double mean = normal.MeanLeft(cell);
    for (Sight& sight : cell.sights) {
      const double off =
          (normal.Left(sight) - mean) / std::sqrt(sight.variance) / (kCauchyScale * sd);
      sight.weight = cell.area / sight.variance / (1.0 + off * off);
    }
  }
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
  std::vector<Cell> cells = SharedCells(views);
  if (auto ok = CheckOverlap(views, cells); !ok) return Propagate(std::move(ok));
  for (Cell& cell : cells) {
    for (Sight& sight : cell.sights) sight.weight = cell.area / sight.variance;
  }
  const bool balls = std::ranges::any_of(
      views, [](const AimedPicture& picture) { return picture.view.ball().has_value(); });
  Normal normal(views.size(), in_gauge, balls ? kMirrorSd : kFalloffSd);
  for (int round = 0; round < kSolveRounds; ++round) {
    normal.Solve(cells);
    Reweigh(normal, cells);
  }
  const Eigen::MatrixXd covariance = normal.Covariance(cells);
  const auto count = static_cast<Eigen::Index>(views.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    scales.factor.push_back(std::exp(-normal.unknowns()[i]));
    scales.sd_relative.push_back(
        std::sqrt(std::max(0.0, covariance(i, i)) + kSamplingSd * kSamplingSd));
  }
  for (Eigen::Index k = 0; k < 3; ++k) {
    scales.falloff[static_cast<std::size_t>(k)] = normal.unknowns()[count + k];
  }
  scales.agreement_sd = SdOfRest(normal, cells, false);
  return scales;
}

}  // namespace lightcal
