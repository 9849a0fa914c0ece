// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/pair_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "lightcal/core/statistics.h"
#include "lightcal/core/student.h"
#include "lightcal/imaging/bracket/motion_tiles.h"

namespace lightcal {
namespace {

constexpr std::size_t kLeastTileCount = 8;
constexpr double kShearSd = 0.01, kScaleSd = 0.03, kPerspectiveSd = 0.1;
constexpr double kFallSd = 1.0;  // of ln(signal) at half the diagonal, by r^2 and by r^4
constexpr double kSettledCells = 0.01;
constexpr double kNearCells = 0.05, kNearlySettledCells = 0.5;
constexpr int kFastPasses = 8;
constexpr double kHeld = 1e12;  // of a number that does not move
constexpr int kMostPasses = 20, kMostClosePasses = 8;
constexpr double kCloseCells = 0.3;  // standard deviation of a coarser level's answer
constexpr double kSureCells = 0.03;  // no coarser level is asked
constexpr double kWideScale = 3.0;   // before residuals are known

using MotionVector = Eigen::Matrix<double, kMotionNumbers, 1>;
using MotionMatrix = Eigen::Matrix<double, kMotionNumbers, kMotionNumbers>;
Eigen::Map<const MotionMatrix> NormalOf(const MotionTile& tile) {
  return Eigen::Map<const MotionMatrix>(tile.normal.data());
}
Eigen::Map<const MotionVector> ScoreOf(const MotionTile& tile) {
  return Eigen::Map<const MotionVector>(tile.score.data());
}
MotionNumbers SpanOf(const MotionVector& numbers) {
  return MotionNumbers(numbers.data(), kMotionNumbers);
}

HalfDiagonals FrameOf(double width, double height) {
  return {0.5 * std::hypot(width, height), 0.5 * width, 0.5 * height};
}

// What hands do, as one over the variances of combinations of the eight numbers.
MotionMatrix Prior() {
  MotionMatrix prior = MotionMatrix::Zero();
  const auto add = [&](int i, int j, double sign, double sd) {
    MotionVector direction = MotionVector::Zero();
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
  add(8, 8, 1.0, kFallSd);
  add(9, 9, 1.0, kFallSd);
  return prior;
}

MotionVector NumbersOf(const Homography& h) {
  MotionVector numbers = MotionVector::Zero();
  for (int i = 0; i < kPlaceNumbers; ++i) numbers(i) = h.m[static_cast<std::size_t>(i)] / h.m[8];
  numbers(0) -= 1.0;
  numbers(4) -= 1.0;
  return numbers;
}

// Of a covariance C of the numbers, trace(F C) is the mean square over the picture of what it means
// at its places, in half diagonals.
MotionMatrix PlaceForm(const HalfDiagonals& frame) {
  constexpr int kAcross = 8;
  MotionMatrix form = MotionMatrix::Zero();
  for (int j = 0; j < kAcross; ++j) {
    for (int i = 0; i < kAcross; ++i) {
      const double u = (2.0 * (i + 0.5) / kAcross - 1.0) * frame.x / frame.half;
      const double v = (2.0 * (j + 0.5) / kAcross - 1.0) * frame.y / frame.half;
      MotionVector x, y;
      x << u, v, 1.0, 0.0, 0.0, 0.0, -u * u, -u * v, 0.0, 0.0;
      y << 0.0, 0.0, 0.0, u, v, 1.0, -u * v, -v * v, 0.0, 0.0;
      form += x * x.transpose() + y * y.transpose();
    }
  }
  return form / (kAcross * kAcross);
}

// What the answers would scatter by were each tile left out once (the jackknife): a few tiles that
// carry the whole answer do not vouch for each other, and that few tell a spread badly themselves
// is in it (Satterthwaite's degrees of freedom).
double SdWithoutEach(const std::vector<MotionTile>& tiles, const MotionMatrix& inverse,
                     const MotionMatrix& prior, const HalfDiagonals& frame) {
  const MotionMatrix form = PlaceForm(frame);
  double square = (form * inverse * prior * inverse).trace();
  double fourth = 0.0;
  for (const MotionTile& tile : tiles) {
    if (!tile.counts) continue;
    const MotionMatrix rest = MotionMatrix::Identity() - NormalOf(tile) * inverse;
    const MotionVector moved = inverse * rest.partialPivLu().solve(ScoreOf(tile));
    const double own = moved.dot(form * moved);
    square += own;
    fourth += own * own;
  }
  const double freedom = std::max(1.0, square * square / std::max(fourth, 1e-300));
  return std::sqrt(square) * StudentOverNormal(freedom);
}

struct Solved {
  MotionVector numbers;
  double sd = HUGE_VAL, unlike = 1.0;  // half diagonals
  double scale = kWideScale;           // residuals' standard deviation over what is told of it
};

// Newton's method at one level. `close`: at the answer but for parts of a cell.
std::optional<Solved> SolveLevel(const MotionPicture& a, const MotionPicture& b,
                                 const HalfDiagonals& frame, const Solved& start, bool close) {
  const MotionTiles level(a, b, frame);
  const MotionMatrix prior = Prior();
  MotionVector numbers = start.numbers;
  double scale = close ? start.scale : kWideScale;
  Steering steering = close ? Steering::kUnbiased : Steering::kFast;
  std::optional<Solved> near;  // where to go on from at a finer level, though nothing is known here
  for (int pass = 0; pass < (close ? kMostClosePasses : kMostPasses); ++pass) {
    const std::vector<MotionTile> tiles = level.Tiles(SpanOf(numbers), scale, steering);
    MotionMatrix normal = MotionMatrix::Zero();
    MotionVector score = MotionVector::Zero();
    double weight = 0.0, kept = 0.0;
    std::size_t count = 0;
    std::vector<float> spread;
    for (const MotionTile& tile : tiles) {
      if (!tile.counts) continue;
      normal += NormalOf(tile);
      score += ScoreOf(tile);
      weight += tile.weight;
      kept += tile.kept;
      ++count;
      for (std::size_t i = 0; i < tile.spread.size(); i += 3) spread.push_back(tile.spread[i]);
    }
    if (count < kLeastTileCount || !(weight > 0.0)) return near;
    scale = std::clamp(UpperMedian(spread) / kNormalQuartile, 0.3, 30.0);
    MotionMatrix precision = normal + prior;
    if (steering == Steering::kFast) {  // the fall-off waits
      precision(8, 8) += kHeld;
      precision(9, 9) += kHeld;
    }
    const auto solver = precision.ldlt();
    if (!solver.isPositive()) return near;
    const MotionVector step = solver.solve(score - prior * numbers);
    if (!step.allFinite()) return near;
    numbers += step;
    const double moved =
        RmsBetween(HomographyOf(SpanOf(step)), Homography{}, 2.0 * frame.x / frame.half, 1.0);
    const double cells = moved * frame.half / a.cell;
    const bool last = pass + 1 == kMostPasses;
    if (steering == Steering::kFast) {
      if (cells < kNearCells || (pass == kFastPasses && cells < kNearlySettledCells)) {
        steering = Steering::kUnbiased;
        near = Solved{numbers};
      }
      continue;
    }
    if (close && cells > kNearlySettledCells) return std::nullopt;
    if (!last && cells > kSettledCells) continue;
    if (last && cells > 0.1) return near;
    const double sd = SdWithoutEach(tiles, solver.solve(MotionMatrix::Identity()), prior, frame);
    return Solved{numbers, sd, 1.0 - kept / weight, scale};
  }
  return near;
}

}  // namespace

std::optional<PairMotion> RefineMotion(const MotionPyramid& frame, const MotionPyramid& other,
                                       double width, double height, const Homography& start,
                                       StartIs start_is) {
  const HalfDiagonals places = FrameOf(width, height);
  const auto solve = [&](std::size_t i, const Solved& from, bool close) {
    return SolveLevel(frame.levels[i], other.levels[i], places, from, close);
  };
  Solved from{NumbersOf(
      start.InPlaces(1.0 / places.half, -places.x / places.half, -places.y / places.half))};
  std::optional<Solved> best;
  const std::size_t levels = std::min(frame.levels.size(), other.levels.size());
  // Noise may leave a finer level less sure than the one before.
  for (std::size_t i = 0; start_is == StartIs::kClose && i < levels; ++i) {
    const auto solved = solve(i, from, true);
    if (best && (!solved || solved->sd > best->sd)) break;
    if (solved) best = solved;
    if (best && best->sd * places.half < kSureCells * frame.levels[0].cell) break;
  }
  for (std::size_t i = best ? 0 : levels; i-- > 0;) {
    const bool close = best && best->sd * places.half < kCloseCells * frame.levels[i].cell;
    auto solved = close ? solve(i, from, true) : std::nullopt;
    if (!solved) solved = solve(i, from, false);
    if (!solved || (best && solved->sd > best->sd)) continue;
    best = from = *solved;
  }
  if (!best || !std::isfinite(best->sd)) return std::nullopt;
  return PairMotion{HomographyOf(SpanOf(best->numbers)).InPlaces(places.half, places.x, places.y),
                    best->sd * places.half, best->unlike};
}

}  // namespace lightcal
