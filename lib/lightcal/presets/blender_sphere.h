// SPDX-License-Identifier: Apache-2.0
// A sphere's near field in Blender. Before 4.0 a point light with a radius is a disc that faces
// each point it lights: I/(d^2 + r^2) (Cycles 3.4, rendered). From 4.0 on it is the sphere itself,
// I/d^2, from 4.1 on where its "Soft Falloff" is off, which the script sees to.
#pragma once

#include <string_view>

namespace lightcal {

inline constexpr std::string_view kOldBlenderSphere =
    "before Blender 4.0 a sphere is a disc that faces each point it lights";
// Less is not told: Cycles' renders are held to half a per cent.
inline constexpr double kLeastLackTold = 0.005;

// Of its light at d from the centre: what is missing before 4.0.
inline double LackOfOldBlenderSphere(double radius_m, double distance_m) {
  const double r2 = radius_m * radius_m;
  return r2 / (distance_m * distance_m + r2);
}

}  // namespace lightcal
