// SPDX-License-Identifier: Apache-2.0
// Cameras turned against each other -> yaw, pitch and roll over a horizon.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/imaging/panorama/aimed_picture.h"
#include "lightcal/imaging/panorama/solve_aims.h"

namespace lightcal {

// One camera's own pitch and roll.
struct KnownPose {
  std::size_t view = 0;
  Radians pitch{0.0}, roll{0.0};
};

struct LevelledAims {
  std::vector<ViewAim> aims;
  bool assumed = false;  // the horizon is a guess
};

// With a known pose its view looks along yaw 0. Without: up is the direction to which the cameras'
// right sides lie most squarely, as if nobody had leaned his camera on purpose; where they do not
// tell (every camera the same way), the mean of their upper sides. Yaw 0 is then the first view's
// that does not look up or down.   Source: Brown & Lowe, IJCV 74 (2007), section 5.
[[nodiscard]] LevelledAims LevelAims(std::span<const CameraAxes> axes,
                                     const std::optional<KnownPose>& known);

}  // namespace lightcal
