// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/engine_axes.h"

#include <cmath>

#include "lightcal/core/units.h"

namespace lightcal {
namespace {

// Without the -0 that atan2 gives.
double Degrees(double radians) {
  const double degrees = DegreesFromRadians(Radians(radians));
  return degrees == 0.0 ? 0.0 : degrees;
}

}  // namespace

UnrealRotator UnrealRotatorFromAxes(const Vec3& forward, const Vec3& right, const Vec3& up) {
  constexpr double kVertical = 1e-9;
  const double level = std::hypot(forward[0], forward[1]);
  UnrealRotator out;
  out.pitch_deg = Degrees(std::atan2(forward[2], level));
  if (level > kVertical) {
    out.yaw_deg = Degrees(std::atan2(forward[1], forward[0]));
    out.roll_deg = Degrees(std::atan2(-right[2], up[2]));
  } else {
    // right = (sin r sin p, cos r, 0)
    out.roll_deg = Degrees(std::atan2(forward[2] > 0.0 ? right[0] : -right[0], right[1]));
  }
  return out;
}

}  // namespace lightcal
