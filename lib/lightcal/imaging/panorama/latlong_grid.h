// SPDX-License-Identifier: Apache-2.0
// The pixels of a lat-long panorama as vectors on the sphere, in the frame of panorama.h: the
// picture's centre looks along +Y, its right side is +X, its upper edge +Z.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/core/view2d.h"

namespace lightcal {

class LatLongGrid {
 public:
  // width and height above 0; azimuth has 2 pi over the width, the zenith angle pi over the height.
  LatLongGrid(int width, int height);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::int32_t Index(int x, int y) const { return y * width_ + x; }
  [[nodiscard]] int X(std::int32_t index) const { return index % width_; }
  [[nodiscard]] int Y(std::int32_t index) const { return index / width_; }
  // The side of a pixel on the equator.
  [[nodiscard]] Radians pitch() const { return pitch_; }

  // Omega = integral of dOmega over a pixel of row y [sr], exact.
  [[nodiscard]] double SolidAngle(int y) const { return solid_angle_[Row(y)]; }
  // Integral of w dOmega over the pixel, w the unit vector it looks along, exact [sr]: what a pixel
  // of luminance L gives a plane of normal n wholly in front of it is  E = L n . Flow.
  [[nodiscard]] Vec3 Flow(int x, int y) const {
    const auto c = static_cast<std::size_t>(x);
    return {aside_[Row(y)] * sine_[c], aside_[Row(y)] * cosine_[c], up_[Row(y)]};
  }
  // Unit vector through the pixel's centre.
  [[nodiscard]] Vec3 Direction(int x, int y) const;
  // The point of the picture (pixel centres at .5) that looks along a unit vector; x in [0, width).
  struct Point {
    double x = 0.0, y = 0.0;
  };
  [[nodiscard]] Point PointOf(const Vec3& direction) const;

  // Calls visit(index) for the pixels around (x, y) within one pitch of angle on each side: across
  // the seam and the poles, and over more columns where meridians draw together.
  template <class Visit>
  void ForNeighbours(int x, int y, const Visit& visit) const {
    for (int dy = -1; dy <= 1; ++dy) {
      // Beyond a pole lies the same row, whose span goes all round.
      const int row = std::clamp(y + dy, 0, height_ - 1);
      const int span = span_[Row(row)];
      const int from = 2 * span + 1 >= width_ ? 0 : x - span;
      const int count = std::min(2 * span + 1, width_);
      for (int i = 0; i < count; ++i) {
        int column = from + i;
        if (column < 0) column += width_;
        if (column >= width_) column -= width_;
        if (column != x || row != y) visit(Index(column, row));
      }
    }
  }

 private:
  [[nodiscard]] static std::size_t Row(int y) { return static_cast<std::size_t>(y); }

  int width_, height_;
  Radians pitch_{0.0};
  std::vector<double> solid_angle_, aside_, up_;  // by row
  std::vector<double> sine_, cosine_;             // by column: integrals over its azimuths
  std::vector<int> span_;                         // by row: columns that one pitch of angle covers
};

// E of a plane of unit normal n in the middle of the sphere:  E = integral of L max(0, n . w)
// dOmega. A pixel that the plane's horizon crosses counts by its middle: below 1e-5 of E from 256
// rows on.
[[nodiscard]] Lux IlluminanceOn(View2d<const float> nits, const LatLongGrid& grid,
                                const Vec3& normal);

}  // namespace lightcal
