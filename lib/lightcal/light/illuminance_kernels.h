// SPDX-License-Identifier: Apache-2.0
// The loops over a map's points. Compiled for several instruction sets, chosen at load time; no
// contraction of a*b+c, so that every processor writes the same bytes.
#pragma once

#include <cstddef>
#include <span>

namespace lightcal::kernels {

// A rectangle of a map whose points lie on one plane: column i at x[i], row j at y[j] [m]. s[i] and
// t[j] run from 0 to 1 between its outermost points.
struct Tile {
  std::span<const double> x, y, s, t;
  float* lux;  // both are added to
  float* u95;
  std::ptrdiff_t stride;  // from row to row
};

// Bilinear between the tile's corners (s, t) = 00, 10, 01, 11.
struct Corners {
  double at00, at10, at01, at11;
};

// A point of candela [cd] over the plane: E = I h/(d (d + offset)^2). u95 += E relative.
struct PointOver {
  double x, y, height;
  double candela, offset;
};
void AddPoint(const Tile& tile, const PointOver& lamp, const Corners& relative_u95);

// A spot of squared-linear, linear or smoothstep fall-off: z = along its aim, linear over the
// plane, s = (1 - z/d)/2 the half versine of the angle from it.
struct SpotOver {
  PointOver point;
  double z_at_origin, z_along_x, z_along_y;
  double s_outer;
  double per_s;    // 1/(s_outer - s_inner)
  double a, b, c;  // f = t (a + t (b + t c))
};
void AddSpot(const Tile& tile, const SpotOver& lamp, const Corners& relative_u95);

// Points of a flat source, each E = w h z/r^4, z = how far before the source's plane the receiver
// stands, 0 behind it.
struct FlatNode {
  double x, y, height;
  double candela;  // its weight's share
};
struct FlatOver {
  std::span<const FlatNode> nodes;
  double z_at_origin, z_along_x, z_along_y;
};
void AddFlat(const Tile& tile, const FlatOver& lamp, const Corners& relative_u95);

// The same everywhere.
void AddEven(const Tile& tile, double lux, const Corners& relative_u95);

// Biquadratic through 3 x 3 values at s, t = 0, 1/2, 1; row after row.
void AddSmooth(const Tile& tile, const double* lux, const Corners& relative_u95);

}  // namespace lightcal::kernels
