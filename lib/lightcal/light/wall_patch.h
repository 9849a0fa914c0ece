// SPDX-License-Identifier: Apache-2.0
// A room's walls, cut into rectangles that shine as Lambertian ones.
#pragma once

#include <array>
#include <vector>

#include "lightcal/light/placed_lamp.h"
#include "lightcal/light/scene.h"

namespace lightcal {

// One of a room's six walls: across an axis, at its low end or its high one.
struct RoomWall {
  int axis = 0;
  bool upper = false;
  // The axes along it.
  [[nodiscard]] constexpr int u() const { return (axis + 1) % 3; }
  [[nodiscard]] constexpr int v() const { return (axis + 2) % 3; }
  [[nodiscard]] double at_m(const Vec3& size_m) const {
    return LowEnd(size_m, axis) + (upper ? size_m[axis] : 0.0);
  }
};
inline constexpr std::array<RoomWall, 6> kRoomWalls{
    {{0, false}, {0, true}, {1, false}, {1, true}, {2, false}, {2, true}}};

struct WallPatch {
  RectSource source;
  LampPose pose;
  [[nodiscard]] double area_m2() const { return 4.0 * source.half_width * source.half_height; }
  // Where and how it receives light.
  [[nodiscard]] SurfacePoint middle() const { return {pose.position_m, pose.frame.z}; }
  // A surface, as this patch shines on it.
  [[nodiscard]] Receiver<double> Seen(const SurfacePoint& at) const {
    return {pose.frame.Of(at.position_m - pose.position_m), pose.frame.Of(at.normal)};
  }
};

// A wall's patches between these edges along wall.u() and wall.v() [m], row by row.
[[nodiscard]] std::vector<WallPatch> PatchesOf(const RoomWall& wall, const Vec3& size_m,
                                               const std::vector<double>& u_edges,
                                               const std::vector<double>& v_edges);

}  // namespace lightcal
