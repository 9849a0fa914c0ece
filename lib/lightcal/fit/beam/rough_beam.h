// SPDX-License-Identifier: Apache-2.0
// What a beam's readings look like as they stand: its curve, how wide it is, the surface they lie
// on, and where a free curve may begin. Internal to this room.
#pragma once

#include <vector>

#include "lightcal/fit/beam/beam_problem.h"

namespace lightcal::fit {

// Candela that a row asks for, and its angle; the axis as it was stated.
struct RoughPoint {
  double gamma = 0.0, candela = 0.0;
};
// Of the lit rows, by angle.
[[nodiscard]] std::vector<RoughPoint> RoughCurve(const std::vector<BeamRow>& rows);

[[nodiscard]] int DistinctAngles(const std::vector<RoughPoint>& curve);

// Half angle where a row's candela fall to half of the largest, by the readings as they stand.
[[nodiscard]] double RoughHalfAngle(const std::vector<BeamRow>& rows);

// The surface that fits the lit rows better, and how far they lie off it: farthest over nearest.
struct ReadingSurface {
  ReadFrom from;
  double spread = 1.0;
};
[[nodiscard]] ReadingSurface SurfaceOf(const std::vector<BeamRow>& rows);

// A free curve through the points, as far as `outermost` or beyond, and where its nodes begin.
struct RoughSmooth {
  BeamShape shape;
  std::vector<double> nodes;
  double peak_cd = 0.0;
};
[[nodiscard]] RoughSmooth SmoothThrough(const std::vector<RoughPoint>& curve, double half_angle,
                                        double outermost, const ReadFrom& from);

// Nodes where a curve may turn sharply: of a lamp that is brightest beside its axis (lenses that
// throw light sideways) those between the readings on both sides of the peak, else the axis itself
// (mirrors and lenses before a small source).
[[nodiscard]] std::vector<int> KinksOf(const std::vector<RoughPoint>& curve,
                                       const BeamShape& shape);

}  // namespace lightcal::fit
