// SPDX-License-Identifier: Apache-2.0
// A room's walls as lamps: what one lamp lights up on them, thrown back onto any surface inside.
#pragma once

#include <cstdint>
#include <vector>

#include "lightcal/light/placed_lamp.h"
#include "lightcal/light/scene.h"

namespace lightcal {

// First bounce: each wall is cut into patches, graded by asinh about the lamp's foot. Further
// bounces: their mean over the room, 1.15 rho^2 Phi/(A (1 - rho)), the same everywhere
// (room_bounce.h says how well that holds).
class WallLight {
 public:
  // kFine: 10 x 10 patches a wall, each lit at 2 x 2 Gauss points and shining as a Lambertian
  // rectangle, within 3 % of a fine sum anywhere in the room. kCoarse: 6 x 6, each lit at its
  // middle and shining as a disk, as room_bounce.h has them: for bounds, at a twentieth of the
  // price.
  enum class Detail : std::uint8_t { kFine, kCoarse };

  // The lamp must follow a distance (not IsEverywhere); outside the room it counts as just inside.
  WallLight(const RoomBox& room, const PlacedLamp& lamp, Detail detail);

  // First bounce and further ones.                                                      [lx]
  [[nodiscard]] double At(const SurfacePoint& at) const;
  // What they cannot exceed (MostBounce).                                               [lx]
  [[nodiscard]] double BoundAt(const SurfacePoint& at) const;
  // 95 % interval of At, relative.
  [[nodiscard]] double u95_relative() const;

 private:
  struct Patch {
    RectSource source;
    LampPose pose;
    double candela = 0.0;
  };
  void AddWall(const PlacedLamp& lamp, int axis, bool upper, int side);
  [[nodiscard]] SurfacePoint Inside(const SurfacePoint& at) const;
  [[nodiscard]] double First(const SurfacePoint& at) const;

  RoomBox room_;
  Detail detail_;
  std::vector<Patch> patches_;
  double tail_ = 0.0;  // rho^2 Phi/(A (1 - rho)) [lx]
  bool even_ = true;   // the lamp shines alike in all directions
};

}  // namespace lightcal
