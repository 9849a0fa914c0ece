// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/latlong_grid.h"

#include <cstddef>
#include <numbers>

#include "lightcal/core/parallel.h"

namespace lightcal {
namespace {

using std::numbers::pi;

}  // namespace

// With zenith angle t in [a, b] and azimuth p:  w = (sin p sin t, cos p sin t, cos t),
//   integral sin t = 2 sin((a+b)/2) sin((b-a)/2)          (solid angle)
//   integral sin^2 t = ((b-a) - cos(a+b) sin(b-a))/2      (aside)
//   integral sin t cos t = sin(b-a) sin(b+a)/2            (up)
LatLongGrid::LatLongGrid(int width, int height)
    : width_(width), height_(height), pitch_(pi / height) {
  const double step = pi / height, azimuth = 2.0 * pi / width;
  for (int y = 0; y < height; ++y) {
    const double a = y * step, sum = 2.0 * a + step;
    solid_angle_.push_back(azimuth * 2.0 * std::sin(sum / 2.0) * std::sin(step / 2.0));
    aside_.push_back((step - std::cos(sum) * std::sin(step)) / 2.0);
    up_.push_back(azimuth * std::sin(step) * std::sin(sum) / 2.0);
    const double columns = std::ceil(step / (azimuth * std::sin(a + step / 2.0)) - 1e-9);
    const bool polar = y == 0 || y == height - 1;
    span_.push_back(polar ? width : static_cast<int>(std::clamp(columns, 1.0, double(width))));
  }
  for (int x = 0; x < width; ++x) {
    const double middle = azimuth * (x + 0.5) - pi;
    const double chord = 2.0 * std::sin(azimuth / 2.0);
    sine_.push_back(chord * std::sin(middle));
    cosine_.push_back(chord * std::cos(middle));
  }
}

Vec3 LatLongGrid::Direction(int x, int y) const {
  const double azimuth = 2.0 * pi * (x + 0.5) / width_ - pi;
  const double zenith = pi * (y + 0.5) / height_;
  return {std::sin(azimuth) * std::sin(zenith), std::cos(azimuth) * std::sin(zenith),
          std::cos(zenith)};
}

LatLongGrid::Point LatLongGrid::PointOf(const Vec3& direction) const {
  const double azimuth = std::atan2(direction[0], direction[1]);
  const double zenith = std::atan2(std::hypot(direction[0], direction[1]), direction[2]);
  double x = (azimuth / (2.0 * pi) + 0.5) * width_;
  if (x >= width_) x -= width_;
  return {x, zenith / pi * height_};
}

Lux IlluminanceOn(View2d<const float> nits, const LatLongGrid& grid, const Vec3& normal) {
  std::vector<double> rows(static_cast<std::size_t>(grid.height()));
  ParallelFor(grid.height(), [&](int y) {
    double sum = 0.0;
    for (int x = 0; x < grid.width(); ++x) {
      sum += nits(x, y) * std::max(0.0, Dot(normal, grid.Flow(x, y)));
    }
    rows[static_cast<std::size_t>(y)] = sum;
  });
  double lux = 0.0;
  for (const double row : rows) lux += row;
  return Lux(lux);
}

}  // namespace lightcal
