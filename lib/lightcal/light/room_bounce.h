// SPDX-License-Identifier: Apache-2.0
// Illuminance that a lamp casts on a meter by way of a room's walls.
#pragma once

#include <cmath>

#include "lightcal/light/scene.h"

namespace lightcal {

// Per candela of axial intensity, on a meter that faces the lamp.
struct Bounce {
  double first = 0.0;   // lx/cd, one bounce
  double tail = 0.0;    // lx/cd, rho^2 Phi/(A (1 - rho)): the mean of all further bounces
  double toward = 1.0;  // intensity towards the meter over that on the axis

  // Estimate of the whole: first + 1.15 tail, within -20 % and +12 % in 500 random boxes.
  [[nodiscard]] double Estimate() const { return first + 1.15 * tail; }
  // What it cannot exceed, over the direct illuminance: (1.2 first + 2 tail) d^2 by the lamp's lobe
  // and the meter's cosine. Infinite where the lamp does not shine on the meter.
  [[nodiscard]] double RelativeBound(const ScenePose& pose) const {
    return (1.2 * first + 2.0 * tail) * pose.distance_m * pose.distance_m /
           (toward * std::cos(pose.tilt_rad));
  }
};

// 1 sigma of Bounce::Estimate(), relative.
inline constexpr double kBounceSigma = 0.10;

// First bounce: Lambertian walls of one reflectance, each cut into n x n patches
// (room.bounce_patches) graded by asinh about the lamp's foot, so that the bright spot under a lamp
// near a wall is resolved. Point, sphere and tube shine evenly, disk and rect as cos, spots within
// their cone, and any lamp of a stated beam as cos^n. A lamp without position stands in the middle
// of the room; a reading without one stands along the aim (or the room's longer side). Points
// outside the room are moved just inside. Requires scene.room, a kind that follows distance.
[[nodiscard]] Bounce BounceAt(const Scene& scene, const ScenePose& pose);

}  // namespace lightcal
