// SPDX-License-Identifier: Apache-2.0
// Directions spread evenly over the sphere.
#pragma once

#include <cmath>
#include <numbers>

#include "lightcal/core/vec3.h"

namespace lightcal {

// Unit vector i of `count`, 0 <= i < count: the golden spiral, from +Z down.
[[nodiscard]] inline Vec3 EvenDirection(int i, int count) {
  const double z = 1.0 - (2.0 * i + 1.0) / count;
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

}  // namespace lightcal
