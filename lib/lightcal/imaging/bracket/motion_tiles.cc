// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/motion_tiles.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "lightcal/core/parallel.h"
#include "lightcal/imaging/bracket/cubic_weights.h"

namespace lightcal {

using TileVector = Eigen::Matrix<double, kMotionNumbers, 1>;
using TileMatrix = Eigen::Matrix<double, kMotionNumbers, kMotionNumbers>;

struct MotionTileCell {
  double residual, weight, ln, around;  // ln(signal) of this one, and of the mean around
  TileVector slopes, steering;          // of the other picture, of this one
  double slope_square, slope_noise;
};

namespace {

constexpr int kTileCells = 24, kLeastTileCells = 8;
constexpr int kTilesAcross = 10;      // where tiles are smaller
constexpr double kSeenShare = 0.06;   // of a tile that counts
constexpr double kModelLn = 0.01;     // of interpolation and curves, in ln(signal)
constexpr double kModelCells = 0.15;  // and along slopes, as places
constexpr double kGainSd = 0.5;       // of the response's slope, by tile
constexpr double kTolerated = 3.0;    // standard deviations from which a cell counts half

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
  const SeenAround around = picture.seen_around[picture.At(ix, iy)];
  if (!around.four) return std::nullopt;
  const auto u = static_cast<float>(left - ix), v = static_cast<float>(top - iy);
  const bool all = around.cubic;
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

// Right and down, from the eight cells around (Sobel's, so that little noise is in it); absent
// where one of them says nothing.
std::optional<std::pair<double, double>> SlopeAt(const MotionPicture& picture, std::size_t at) {
  if (!picture.seen_around[at].eight) return std::nullopt;
  const auto row = static_cast<std::size_t>(picture.width);
  const auto ln = [&](std::size_t i) { return double{picture.ln[i]}; };
  const std::size_t up = at - row, down = at + row;
  const double right = ln(up + 1) + 2.0 * ln(at + 1) + ln(down + 1);
  const double left = ln(up - 1) + 2.0 * ln(at - 1) + ln(down - 1);
  const double above = ln(up - 1) + 2.0 * ln(up) + ln(up + 1);
  const double below = ln(down - 1) + 2.0 * ln(down) + ln(down + 1);
  return std::pair{(right - left) / 8.0, (below - above) / 8.0};
}
constexpr double kSlopeNoise = 0.1875;  // variance of either slope over a cell's

// What a tile cannot tell from a motion's residuals: a constant and what goes with ln(signal),
// which are the exposure, the lens's fall-off and a response that is not known. The gain is found
// by the mean around, whose noise is little: by ln(signal) itself it would be too small.
class MotionTileLevel {
 public:
  MotionTileLevel(const std::vector<MotionTileCell>& cells, const std::vector<double>& weights,
                  Steering steering)
      : cells_(cells), weights_(weights), gains_(steering == Steering::kUnbiased) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      total_ += weights[i];
      ln_ += weights[i] * cells[i].ln;
      around_ += weights[i] * cells[i].around;
    }
    ln_ /= total_;
    around_ /= total_;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      square_ += weights[i] * (cells[i].around - around_) * (cells[i].ln - ln_);
    }
    square_ = std::max(square_, 0.0) + 1.0 / (kGainSd * kGainSd);
  }

  [[nodiscard]] double total() const { return total_; }

  // What is left of values, one a cell, without both; `value(cell)` gives a number or a vector.
  template <typename Value, typename Of>
  [[nodiscard]] std::vector<Value> Without(const Value& zero, Of&& value) const {
    Value mean = zero, gain = zero;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Value of = value(cells_[i]);
      mean += weights_[i] * of;
      gain += weights_[i] * (cells_[i].around - around_) * of;
    }
    mean /= total_;
    gain *= gains_ ? 1.0 / square_ : 0.0;
    std::vector<Value> left;
    left.reserve(cells_.size());
    for (const MotionTileCell& cell : cells_) {
      left.push_back(value(cell) - mean - (cell.ln - ln_) * gain);
    }
    return left;
  }

 private:
  const std::vector<MotionTileCell>& cells_;
  const std::vector<double>& weights_;
  bool gains_;  // a gain leaves too little of a coarse picture to find the way by
  double total_ = 0.0, ln_ = 0.0, around_ = 0.0, square_ = 0.0;
};

// How much of a tile's slopes is not noise: where nothing is to be seen nothing is said.
double TrueShare(const std::vector<MotionTileCell>& cells) {
  double square = 0.0, noise = 0.0;
  for (const MotionTileCell& cell : cells) {
    square += cell.slope_square * cell.weight;
    noise += cell.slope_noise * cell.weight;
  }
  return square > noise ? 1.0 - noise / square : 0.0;
}

MotionTile TileOf(const std::vector<MotionTileCell>& cells, double scale, Steering steering) {
  MotionTile tile;
  TileMatrix normal = TileMatrix::Zero();
  TileVector score = TileVector::Zero();
  tile.counts = true;
  std::vector<double> weights;
  for (const MotionTileCell& cell : cells) weights.push_back(cell.weight / (scale * scale));
  const std::vector<double> before = weights;
  const auto residual_of = [](const MotionTileCell& cell) { return cell.residual; };
  for (int turn = 0; turn < 2; ++turn) {
    const auto residuals = MotionTileLevel(cells, weights, steering).Without(0.0, residual_of);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const double far = 1.0 + residuals[i] * residuals[i] * before[i] / (kTolerated * kTolerated);
      weights[i] = before[i] / (far * far);
    }
  }
  const MotionTileLevel level(cells, weights, steering);
  const TileVector zero = TileVector::Zero();
  const auto residuals = level.Without(0.0, residual_of);
  const auto slopes = level.Without(
      zero, [](const MotionTileCell& cell) -> const TileVector& { return cell.slopes; });
  TileVector steering_mean = zero;
  for (std::size_t i = 0; i < cells.size(); ++i) steering_mean += weights[i] * cells[i].steering;
  steering_mean /= level.total();
  const double told = steering == Steering::kFast ? 1.0 : TrueShare(cells);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    TileVector pulled = cells[i].steering - steering_mean;
    pulled.head<kPlaceNumbers>() *= told;
    const double r = residuals[i];
    normal.noalias() += weights[i] * pulled * slopes[i].transpose();
    score -= weights[i] * r * pulled;
    const double information = pulled.head<kPlaceNumbers>().squaredNorm();
    tile.weight += before[i] * information;
    tile.kept += weights[i] * information;
    tile.spread.push_back(static_cast<float>(std::abs(r) * std::sqrt(cells[i].weight)));
  }
  Eigen::Map<TileMatrix>(tile.normal.data()) = 0.5 * (normal + normal.transpose());
  Eigen::Map<TileVector>(tile.score.data()) = score;
  return tile;
}

}  // namespace

Homography HomographyOf(MotionNumbers numbers) {
  Homography h;
  for (int i = 0; i < kPlaceNumbers; ++i)
    h.m[static_cast<std::size_t>(i)] = numbers[static_cast<std::size_t>(i)];
  h.m[0] += 1.0;
  h.m[4] += 1.0;
  h.m[8] = 1.0;
  return h;
}

MotionTiles::MotionTiles(const MotionPicture& a, const MotionPicture& b, const HalfDiagonals& frame)
    : a_(a),
      b_(b),
      frame_(frame),
      tile_(std::clamp(a.width / kTilesAcross, kLeastTileCells, kTileCells)) {}

std::vector<MotionTile> MotionTiles::Tiles(MotionNumbers numbers, double scale,
                                           Steering steering) const {
  const int across = (a_.width + tile_ - 1) / tile_;
  const int down = (a_.height + tile_ - 1) / tile_;
  std::vector<MotionTile> tiles(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  ParallelFor(down, [&](int row) {
    std::vector<MotionTileCell> cells;
    for (int column = 0; column < across; ++column) {
      Gather(numbers, column * tile_, row * tile_, steering, cells);
      if (static_cast<double>(cells.size()) < kSeenShare * tile_ * tile_) continue;
      tiles[static_cast<std::size_t>(row) * static_cast<std::size_t>(across) +
            static_cast<std::size_t>(column)] = TileOf(cells, scale, steering);
    }
  });
  return tiles;
}

void MotionTiles::Gather(MotionNumbers numbers, int x0, int y0, Steering steering,
                         std::vector<MotionTileCell>& cells) const {
  cells.clear();
  const Homography h = HomographyOf(numbers);
  const double per_half = frame_.half / a_.cell;  // cells
  for (int y = std::max(1, y0); y < std::min(y0 + tile_, a_.height - 1); ++y) {
    for (int x = std::max(1, x0); x < std::min(x0 + tile_, a_.width - 1); ++x) {
      const std::size_t at = a_.At(x, y);
      const auto slope = SlopeAt(a_, at);
      if (a_.variance[at] < 0.0F || (!slope && steering == Steering::kUnbiased)) continue;
      const double u = ((x + 0.5) * a_.cell - frame_.x) / frame_.half;
      const double v = ((y + 0.5) * a_.cell - frame_.y) / frame_.half;
      const auto [s, t] = h(u, v);
      const auto seen = SeenAt(b_, (s * frame_.half + frame_.x) / b_.cell,
                               (t * frame_.half + frame_.y) / b_.cell);
      if (!seen) continue;
      const double gx = slope ? slope->first : double{seen->slope_x};
      const double gy = slope ? slope->second : double{seen->slope_y};
      const double variance =
          a_.variance[at] + seen->variance + kModelLn * kModelLn +
          kModelCells * kModelCells * std::abs(gx * seen->slope_x + gy * seen->slope_y);
      const double before = u * u + v * v, after = s * s + t * t;
      const double fall = after - before, fall_square = after * after - before * before;
      const double w = h.m[6] * u + h.m[7] * v + h.m[8];
      const auto of_numbers = [&](double slope_x, double slope_y) {
        const double px = slope_x * per_half / w, py = slope_y * per_half / w;
        const double pull = -(px * s + py * t);
        TileVector slopes;
        slopes << px * u, px * v, px, py * u, py * v, py, pull * u, pull * v, fall, fall_square;
        return slopes;
      };
      MotionTileCell& cell = cells.emplace_back();
      cell.residual = double{seen->value} - double{a_.ln[at]} + numbers[kPlaceNumbers] * fall +
                      numbers[kPlaceNumbers + 1] * fall_square;
      cell.weight = 1.0 / variance;
      cell.ln = a_.ln[at];
      cell.around = a_.around[at];
      cell.slopes = of_numbers(seen->slope_x, seen->slope_y);
      cell.steering = of_numbers(gx, gy);
      cell.slope_square = gx * gx + gy * gy;
      cell.slope_noise = 2.0 * kSlopeNoise * double{a_.variance[at]};
      if (steering == Steering::kFast) {
        cell.slopes = cell.steering = 0.5 * (cell.slopes + cell.steering);
      }
    }
  }
}

}  // namespace lightcal
