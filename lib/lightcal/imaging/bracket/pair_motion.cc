// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/pair_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "lightcal/core/parallel.h"
#include "lightcal/core/statistics.h"
#include "lightcal/imaging/bracket/cubic_weights.h"

namespace lightcal {
namespace {

using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

constexpr int kTileCells = 24, kLeastTileCells = 8;
constexpr int kTilesAcross = 10;     // where tiles are smaller
constexpr double kSeenShare = 0.15;  // of a tile that counts
constexpr std::size_t kLeastTileCount = 12;
constexpr double kModelLn = 0.01;     // of interpolation and curves, in ln(signal)
constexpr double kModelCells = 0.15;  // and along slopes, as places
constexpr double kTolerated = 3.0;    // standard deviations from which a cell counts half
constexpr double kShearSd = 0.01, kScaleSd = 0.03, kPerspectiveSd = 0.1;
constexpr double kSettledCells = 0.01;
constexpr int kMostPasses = 15;

// Places over half the diagonal from the picture's middle.
struct HalfDiagonals {
  double half = 1.0, x = 0.0, y = 0.0;
};

HalfDiagonals FrameOf(double width, double height) {
  return {0.5 * std::hypot(width, height), 0.5 * width, 0.5 * height};
}

// Weights of four neighbours, for the value and for its slope.
struct CubicTaps {
  std::array<float, 4> value, slope;
};
CubicTaps TapsAt(float t) { return {CubicWeightsAt(t), CubicSlopesAt(t)}; }

struct SeenCell {
  float value, slope_x, slope_y, variance;
};
// At a place of the level, cell centres at .5: cubic, linear where a cell around says nothing;
// absent where one of the nearest four does.
std::optional<SeenCell> SeenAt(const MotionPicture& picture, double x, double y) {
  const double left = x - 0.5, top = y - 0.5;
  const int ix = static_cast<int>(std::floor(left)), iy = static_cast<int>(std::floor(top));
  if (ix < 1 || iy < 1 || ix + 2 >= picture.width || iy + 2 >= picture.height) return std::nullopt;
  const auto u = static_cast<float>(left - ix), v = static_cast<float>(top - iy);
  bool all = true;
  for (int j = 0; j < 4; ++j) {
    const std::size_t at = picture.At(ix - 1, iy - 1 + j);
    for (std::size_t i = 0; i < 4; ++i) {
      if (picture.variance[at + i] >= 0.0F) continue;
      if ((i == 1 || i == 2) && (j == 1 || j == 2)) return std::nullopt;
      all = false;
    }
  }
  const CubicTaps linear_u{{0.0F, 1.0F - u, u, 0.0F}, {0.0F, -1.0F, 1.0F, 0.0F}};
  const CubicTaps linear_v{{0.0F, 1.0F - v, v, 0.0F}, {0.0F, -1.0F, 1.0F, 0.0F}};
  const CubicTaps across = all ? TapsAt(u) : linear_u, down = all ? TapsAt(v) : linear_v;
  SeenCell seen{0.0F, 0.0F, 0.0F, 0.0F};
  for (int j = 0; j < 4; ++j) {
    const std::size_t at = picture.At(ix - 1, iy - 1 + j);
    const auto row = static_cast<std::size_t>(j);
    if (!all && (j == 0 || j == 3)) continue;
    float line = 0.0F, slope = 0.0F, variance = 0.0F;
    for (std::size_t i = 0; i < 4; ++i) {
      if (!all && (i == 0 || i == 3)) continue;
      line += across.value[i] * picture.ln[at + i];
      slope += across.slope[i] * picture.ln[at + i];
      variance += across.value[i] * across.value[i] * picture.variance[at + i];
    }
    seen.value += down.value[row] * line;
    seen.slope_x += down.value[row] * slope;
    seen.slope_y += down.slope[row] * line;
    seen.variance += down.value[row] * down.value[row] * variance;
  }
  return seen;
}

struct TileCell {
  double residual, weight;
  Vector8 slopes;
};

// What a tile says about the eight numbers, its own constant taken out.
struct Tile {
  Matrix8 normal = Matrix8::Zero();
  Vector8 score = Vector8::Zero();
  double weight = 0.0, kept = 0.0;  // sums of weights before and after what moved is left out
  std::vector<float> spread;        // |residual| in its standard deviations
  bool counts = false;
};

double MeanResidual(const std::vector<TileCell>& cells, const std::vector<double>& weights) {
  double sum = 0.0, total = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    sum += weights[i] * cells[i].residual;
    total += weights[i];
  }
  return sum / total;
}

class AlignedLevel {
 public:
  AlignedLevel(const MotionPicture& a, const MotionPicture& b, const HalfDiagonals& frame)
      : a_(a),
        b_(b),
        frame_(frame),
        tile_(std::clamp(a.width / kTilesAcross, kLeastTileCells, kTileCells)) {}

  [[nodiscard]] std::vector<Tile> Tiles(const Homography& h, double scale) const {
    const int across = (a_.width + tile_ - 1) / tile_;
    const int down = (a_.height + tile_ - 1) / tile_;
    std::vector<Tile> tiles(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    ParallelFor(down, [&](int row) {
      std::vector<TileCell> cells;
      for (int column = 0; column < across; ++column) {
        Gather(h, column * tile_, row * tile_, cells);
        if (static_cast<double>(cells.size()) < kSeenShare * tile_ * tile_) continue;
        tiles[static_cast<std::size_t>(row) * static_cast<std::size_t>(across) +
              static_cast<std::size_t>(column)] = TileOf(cells, scale);
      }
    });
    return tiles;
  }

 private:
  void Gather(const Homography& h, int x0, int y0, std::vector<TileCell>& cells) const {
    cells.clear();
    const double per_half = frame_.half / a_.cell;  // cells
    for (int y = std::max(1, y0); y < std::min(y0 + tile_, a_.height - 1); ++y) {
      for (int x = std::max(1, x0); x < std::min(x0 + tile_, a_.width - 1); ++x) {
        const std::size_t at = a_.At(x, y);
        const auto above = at - static_cast<std::size_t>(a_.width);
        const auto below = at + static_cast<std::size_t>(a_.width);
        if (a_.variance[at] < 0.0F) continue;
        const bool slopes = a_.variance[at - 1] >= 0.0F && a_.variance[at + 1] >= 0.0F &&
                            a_.variance[above] >= 0.0F && a_.variance[below] >= 0.0F;
        const double u = ((x + 0.5) * a_.cell - frame_.x) / frame_.half;
        const double v = ((y + 0.5) * a_.cell - frame_.y) / frame_.half;
        const auto [s, t] = h(u, v);
        const auto seen = SeenAt(b_, (s * frame_.half + frame_.x) / b_.cell,
                                 (t * frame_.half + frame_.y) / b_.cell);
        if (!seen) continue;
        // Slopes of both: nearer to the middle of the way than either.
        double gx = seen->slope_x, gy = seen->slope_y;
        if (slopes) {
          gx = 0.5 * (gx + 0.5 * (a_.ln[at + 1] - a_.ln[at - 1]));
          gy = 0.5 * (gy + 0.5 * (a_.ln[below] - a_.ln[above]));
        }
        const double variance = a_.variance[at] + seen->variance + kModelLn * kModelLn +
                                kModelCells * kModelCells * (gx * gx + gy * gy);
        const double w = h.m[6] * u + h.m[7] * v + h.m[8];
        const double px = gx * per_half / w, py = gy * per_half / w;
        const double pull = -(px * s + py * t);
        TileCell& cell = cells.emplace_back();
        cell.residual = double{seen->value} - double{a_.ln[at]};
        cell.weight = 1.0 / variance;
        cell.slopes << px * u, px * v, px, py * u, py * v, py, pull * u, pull * v;
      }
    }
  }

  static Tile TileOf(const std::vector<TileCell>& cells, double scale) {
    Tile tile;
    tile.counts = true;
    std::vector<double> weights;
    for (const TileCell& cell : cells) weights.push_back(cell.weight / (scale * scale));
    const std::vector<double> before = weights;
    double mean = MeanResidual(cells, weights);
    for (int turn = 0; turn < 2; ++turn) {
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const double r = cells[i].residual - mean;
        const double far = 1.0 + r * r * before[i] / (kTolerated * kTolerated);
        weights[i] = before[i] / (far * far);
      }
      mean = MeanResidual(cells, weights);
    }
    Vector8 slope_sum = Vector8::Zero();
    double total = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      slope_sum += weights[i] * cells[i].slopes;
      total += weights[i];
    }
    const Vector8 slope_mean = slope_sum / total;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Vector8 slopes = cells[i].slopes - slope_mean;
      const double r = cells[i].residual - mean;
      tile.normal.selfadjointView<Eigen::Lower>().rankUpdate(slopes, weights[i]);
      tile.score -= weights[i] * r * slopes;
      const double information = slopes.squaredNorm();
      tile.weight += before[i] * information;
      tile.kept += weights[i] * information;
      tile.spread.push_back(static_cast<float>(std::abs(r) * std::sqrt(cells[i].weight)));
    }
    tile.normal = Matrix8(tile.normal.selfadjointView<Eigen::Lower>());
    return tile;
  }

  const MotionPicture& a_;
  const MotionPicture& b_;
  const HalfDiagonals& frame_;
  int tile_;
};

// What hands do, as one over the variances of combinations of the eight numbers.
Matrix8 Prior() {
  Matrix8 prior = Matrix8::Zero();
  const auto add = [&](int i, int j, double sign, double sd) {
    Vector8 direction = Vector8::Zero();
    direction(i) = 0.5;
    if (i != j) direction(j) = sign * 0.5;
    if (i == j) direction(i) = 1.0;
    prior += direction * direction.transpose() / (sd * sd);
  };
  add(0, 4, 1.0, kScaleSd);
  add(0, 4, -1.0, kShearSd);
  add(1, 3, 1.0, kShearSd);
  add(6, 6, 1.0, kPerspectiveSd);
  add(7, 7, 1.0, kPerspectiveSd);
  return prior;
}

Vector8 NumbersOf(const Homography& h) {
  Vector8 numbers;
  for (int i = 0; i < 8; ++i) numbers(i) = h.m[static_cast<std::size_t>(i)] / h.m[8];
  numbers(0) -= 1.0;
  numbers(4) -= 1.0;
  return numbers;
}

Homography HomographyOf(const Vector8& numbers) {
  Homography h;
  for (int i = 0; i < 8; ++i) h.m[static_cast<std::size_t>(i)] = numbers(i);
  h.m[0] += 1.0;
  h.m[4] += 1.0;
  h.m[8] = 1.0;
  return h;
}

// Root mean square over the picture of what this covariance of the numbers means at its places, in
// half diagonals.
double RmsOf(const Matrix8& covariance, const HalfDiagonals& frame) {
  constexpr int kAcross = 8;
  double sum = 0.0;
  for (int j = 0; j < kAcross; ++j) {
    for (int i = 0; i < kAcross; ++i) {
      const double u = (2.0 * (i + 0.5) / kAcross - 1.0) * frame.x / frame.half;
      const double v = (2.0 * (j + 0.5) / kAcross - 1.0) * frame.y / frame.half;
      Vector8 x, y;
      x << u, v, 1.0, 0.0, 0.0, 0.0, -u * u, -u * v;
      y << 0.0, 0.0, 0.0, u, v, 1.0, -u * v, -v * v;
      sum += x.dot(covariance * x) + y.dot(covariance * y);
    }
  }
  return std::sqrt(sum / (kAcross * kAcross));
}

struct Solved {
  Vector8 numbers;
  double sd = 0.0, unlike = 0.0;  // half diagonals
};

std::optional<Solved> SolveLevel(const MotionPicture& a, const MotionPicture& b,
                                 const HalfDiagonals& frame, Vector8 numbers) {
  const AlignedLevel level(a, b, frame);
  const Matrix8 prior = Prior();
  double scale = 3.0;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const std::vector<Tile> tiles = level.Tiles(HomographyOf(numbers), scale);
    Matrix8 normal = Matrix8::Zero(), scatter = Matrix8::Zero();
    Vector8 score = Vector8::Zero();
    double weight = 0.0, kept = 0.0;
    std::size_t count = 0;
    std::vector<float> spread;
    for (const Tile& tile : tiles) {
      if (!tile.counts) continue;
      normal += tile.normal;
      score += tile.score;
      scatter += tile.score * tile.score.transpose();
      weight += tile.weight;
      kept += tile.kept;
      ++count;
      for (std::size_t i = 0; i < tile.spread.size(); i += 3) spread.push_back(tile.spread[i]);
    }
    if (count < kLeastTileCount || !(weight > 0.0)) return std::nullopt;
    scale = std::clamp(UpperMedian(spread) / kNormalQuartile, 0.3, 30.0);
    const Matrix8 precision = normal + prior;
    const auto solver = precision.ldlt();
    const Vector8 step = solver.solve(score - prior * numbers);
    if (!step.allFinite()) return std::nullopt;
    numbers += step;
    const double moved =
        RmsBetween(HomographyOf(step), Homography{}, 2.0 * frame.x / frame.half, 1.0);
    const bool last = pass + 1 == kMostPasses;
    if (!last && moved * frame.half / a.cell > kSettledCells) continue;
    if (last && moved * frame.half / a.cell > 0.1) return std::nullopt;
    const Matrix8 inverse = solver.solve(Matrix8::Identity());
    const double few = static_cast<double>(count) / std::max(1.0, static_cast<double>(count) - 8.0);
    const Matrix8 covariance = inverse * (few * scatter + prior) * inverse;
    return Solved{numbers, RmsOf(covariance, frame), 1.0 - kept / weight};
  }
  return std::nullopt;
}

}  // namespace

std::optional<PairMotion> RefineMotion(const MotionPyramid& frame, const MotionPyramid& other,
                                       double width, double height, const Homography& start) {
  const HalfDiagonals places = FrameOf(width, height);
  std::optional<Solved> best;
  Vector8 numbers = NumbersOf(
      start.InPlaces(1.0 / places.half, -places.x / places.half, -places.y / places.half));
  for (std::size_t i = std::min(frame.levels.size(), other.levels.size()); i-- > 0;) {
    const auto solved = SolveLevel(frame.levels[i], other.levels[i], places, numbers);
    if (!solved) continue;
    if (best && solved->sd > best->sd) continue;
    best = solved;
    numbers = solved->numbers;
  }
  if (!best) return std::nullopt;
  return PairMotion{HomographyOf(best->numbers).InPlaces(places.half, places.x, places.y),
                    best->sd * places.half, best->unlike};
}

}  // namespace lightcal
