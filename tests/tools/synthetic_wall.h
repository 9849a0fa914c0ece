// SPDX-License-Identifier: Apache-2.0
// SYNTHETIC: a lamp lights a painted wall on which a printed board hangs, and a camera with a real
// lens's faults photographs it. The truth that wall captures are held against: no header of
// lightcal is included here.
//
// Wall coordinates in metres: the wall is y = 0, x to the right, z up, the board's lower left
// corner at the origin; lamp and camera stand at y < 0.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lightcal::test {

using Point3 = std::array<double, 3>;

struct PrintedRectangle {
  double x = 0.0, z = 0.0, width = 0.0, height = 0.0;
  bool black = true;
};

// Candela towards a direction (unit length) of wall coordinates.
using SyntheticIntensity = std::function<double(const Point3& direction)>;

// A spot of 900 cd whose half peak lies 15 degrees off its axis, in a soft glow; aims along +Y.
[[nodiscard]] double SpotInAGlow(const Point3& direction);
// Two lobes of different height and width beside the axis +Y, no symmetry.
[[nodiscard]] double TwoLobes(const Point3& direction);

struct SyntheticWall {
  int width = 1000, height = 750;
  double focal_px = 800.0;
  double centre_x_off = 3.0, centre_y_off = -2.0;  // principal point, pixels off the middle
  double k1 = -0.08, k2 = 0.02;                    // radial distortion
  double p1 = 0.0005;                              // decentring, which no estimator here knows
  Point3 camera{0.6, -1.4, 0.5}, looks_at{0.5, 0.0, 0.35};
  double roll_deg = 1.0;
  Point3 lamp{0.5, -1.0, 0.35};
  SyntheticIntensity intensity;
  // Light on the wall at (x, z) that does not come from the lamp, in lx.
  std::function<double(double x, double z)> other_lx;
  double glare = 0.0;  // part of the picture's mean that the lens lays on every pixel
  double wall_reflectance = 0.8, paper_reflectance = 0.85, ink_reflectance = 0.04;
  std::vector<PrintedRectangle> board;              // painted in this order
  double paper_width = 0.297, paper_height = 0.21;  // the sheet about the chessboard's middle
  double board_width = 0.27, board_height = 0.18;
  double vignetting = 3.6;  // exponent of the cosine off the axis
  double gloss = 0.0;       // part missing at grazing incidence
  double noise_relative = 0.01;
  double blur_px = 0.0;  // 1 sigma
  std::uint64_t seed = 1;
};

// The box, x, y, width, height, around the pixels that see the wall within `radius` of (x, z).
[[nodiscard]] std::array<int, 4> PixelsAround(const SyntheticWall& wall, double x, double z,
                                              double radius);
// Luminance in cd/m^2, row by row; pixels about the board are averages
// of 4 x 4 points.
[[nodiscard]] std::vector<float> PhotographWall(const SyntheticWall& wall);

// The rectangles of an SVG board as `lightcal plan --board` prints it, in metres from the
// chessboard's lower left corner.
[[nodiscard]] std::vector<PrintedRectangle> RectanglesOfSvg(const std::string& svg);

// Flux and peak by brute force over the cone of this half angle about `aim`.
struct ConeTruth {
  double flux_lm = 0.0, peak_cd = 0.0;
};
[[nodiscard]] ConeTruth TruthWithin(const SyntheticIntensity& intensity, const Point3& aim,
                                    double half_angle_deg);

}  // namespace lightcal::test
