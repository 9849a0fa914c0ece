// SPDX-License-Identifier: Apache-2.0
// What the tiles of two pictures say about how one lies in the other.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lightcal/imaging/bracket/homography.h"
#include "lightcal/imaging/bracket/motion_pyramid.h"

namespace lightcal {

// Eight of the homography, two of the fall-off that every frame has.
constexpr int kPlaceNumbers = 8, kMotionNumbers = 10;
using MotionNumbers = std::span<const double, kMotionNumbers>;

// Places over half the diagonal from the picture's middle.
struct HalfDiagonals {
  double half = 1.0, x = 0.0, y = 0.0;
};

// Of places in half diagonals.
[[nodiscard]] Homography HomographyOf(MotionNumbers numbers);

// What a tile says about the eight numbers, its own constant taken out.
struct MotionTile {
  std::array<double, kMotionNumbers * kMotionNumbers> normal{};  // symmetric
  std::array<double, kMotionNumbers> score{};
  double weight = 0.0, kept = 0.0;  // sums of weights before and after what moved is left out
  std::vector<float> spread;        // |residual| in its standard deviations
  bool counts = false;
};

// Far from the answer the slopes of both pictures lead there sooner. At the answer only those of
// the picture that is not interpolated may weigh residuals: they share no noise with them, so that
// noise pulls nowhere; and what the residual changes by is the other picture's (an instrument and
// its regressor), or noise would count as detail.
enum class Steering { kFast, kUnbiased };

struct MotionTileCell;

// One level of both pictures.
class MotionTiles {
 public:
  MotionTiles(const MotionPicture& a, const MotionPicture& b, const HalfDiagonals& frame);

  // Where `numbers` put the other picture; `scale`: standard deviations of residuals over what
  // their variances say. A tile counts where enough of it is seen in both.
  [[nodiscard]] std::vector<MotionTile> Tiles(MotionNumbers numbers, double scale,
                                              Steering steering) const;

 private:
  void Gather(MotionNumbers numbers, int x0, int y0, Steering steering,
              std::vector<MotionTileCell>& cells) const;

  const MotionPicture& a_;
  const MotionPicture& b_;
  const HalfDiagonals& frame_;
  int tile_;
};

}  // namespace lightcal
