// SPDX-License-Identifier: Apache-2.0
// Illuminance that a lamp casts on a meter by way of a room's walls.
#pragma once

#include <cmath>

#include "lightcal/light/scene.h"

namespace lightcal {

// What a room's bounce cannot exceed, from its first bounce and the mean of the further ones, where
// that mean is the same everywhere: a lamp that lights a part of the room leaves more near that
// part. 0 of 200 rooms by radiosity lay above for even lamps, 0 of 200 for Lambertian ones, 1 of
// 200 for beams (tests/light/gate_truth_test).
[[nodiscard]] constexpr double MostBounce(double first, double tail, bool even) {
  return even ? 1.35 * first + 2.0 * tail : 1.5 * first + 6.0 * tail;
}
// Its estimate. Against radiosity, p5 to p95: -25 to 0 % for even lamps, -30 to +23 % for
// Lambertian ones, -56 to +45 % for beams.
[[nodiscard]] constexpr double MeanBounce(double first, double tail) { return first + 1.15 * tail; }
// 1 sigma of the estimate, relative.
[[nodiscard]] constexpr double BounceSigma(bool even) { return even ? 0.13 : 0.27; }

// Per candela of axial intensity, on a meter that faces the lamp.
struct Bounce {
  double first = 0.0;   // lx/cd, one bounce
  double tail = 0.0;    // lx/cd, rho^2 Phi/(A (1 - rho)): the mean of all further bounces
  double toward = 1.0;  // intensity towards the meter over that on the axis
  bool even = true;     // the lamp shines alike in all directions

  [[nodiscard]] double Estimate() const { return MeanBounce(first, tail); }
  // What it cannot exceed, over the direct illuminance, by the lamp's lobe and the meter's cosine.
  // Infinite where the lamp does not shine on the meter.
  [[nodiscard]] double RelativeBound(const ScenePose& pose) const {
    return MostBounce(first, tail, even) * pose.distance_m * pose.distance_m /
           (toward * std::cos(pose.tilt_rad));
  }
};

// First bounce: Lambertian walls of one reflectance, each cut into n x n patches
// (room.bounce_patches) graded by asinh about the lamp's foot, so that the bright spot under a lamp
// near a wall is resolved, and cut further where the meter is near it. Point, sphere and tube shine
// evenly, disk and rect as cos, spots within their cone, and any lamp of a stated beam as cos^n. A
// lamp without position stands in the middle of the room; a reading without one stands along the
// aim (or the room's longer side). Points outside the room are moved just inside. Requires
// scene.room, a kind that follows distance.
[[nodiscard]] Bounce BounceAt(const Scene& scene, const ScenePose& pose);

}  // namespace lightcal
