// SPDX-License-Identifier: Apache-2.0
// The true size of an evenly bright face that its picture's blur makes larger and dimmer.
#pragma once

#include <optional>

namespace lightcal {

enum class FaceShape { kRound, kRectangular };

// What a picture shows: `area` is flux over the brightest pixel's luminance, variances are those of
// the light along the face's two axes, all in one unit of length. A blur keeps the flux.
struct BlurredFace {
  double area = 0.0;
  double variance_long = 0.0, variance_short = 0.0;
};

// What it is of. `share` = its area over that of the blurred face: what of the face's luminance its
// brightest pixel still holds.
struct SharpFace {
  double area = 0.0, longer = 0.0, shorter = 0.0, share = 1.0;
};

// Solved for the sides and a Gaussian blur of standard deviation b:
//   round, radius r:        v = r^2/4 + b^2,  A = pi r^2 / (1 - exp(-r^2 / (2 b^2)))
//   rectangular, w and h:   v = w^2/12 + b^2 each,
//                           A = w h / (erf(w / (sqrt(8) b)) erf(h / (sqrt(8) b)))
// A round face's sides are those of the square of its area. No blur is taken where A is that of a
// sharp face or larger.  Nothing: where the blur alone explains what is seen.
[[nodiscard]] std::optional<SharpFace> Sharpened(const BlurredFace& seen, FaceShape shape);

}  // namespace lightcal
