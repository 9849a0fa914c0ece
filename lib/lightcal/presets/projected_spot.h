// SPDX-License-Identifier: Apache-2.0
// A spot's beam as a square picture before a light that projects it, as three.js does
// (SpotLight.map), and what its texels make of the beam.
#pragma once

#include <optional>

#include "lightcal/core/units.h"
#include "lightcal/photometry/spot_cone.h"

namespace lightcal {

// Texel x of a row shows tan(half_angle) (2 (x + .5)/kProjectedTexels - 1) beside the axis, at
// distance 1; between texels bilinear.
inline constexpr int kProjectedTexels = 1024;

struct ProjectedSpot {
  Radians half_angle{0.0};  // of the picture: the whole beam and a dark rim
  double worst = 0.0;       // largest |picture - beam| in any direction, over the axial intensity
  Radians worst_at{0.0};    // from the axis
};

// Of the squared-linear law. Absent: beams that end beyond 80 degrees from the axis.
[[nodiscard]] std::optional<ProjectedSpot> ProjectionOf(const SpotCone& cone);

}  // namespace lightcal
