// SPDX-License-Identifier: Apache-2.0
// A room's walls as lamps: what one lamp lights up on them, thrown back onto any surface inside.
#pragma once

#include <vector>

#include "lightcal/light/placed_lamp.h"
#include "lightcal/light/scene.h"

namespace lightcal {

// First bounce: each wall is cut into side x side patches, graded by asinh about the lamp's foot,
// lit by the lamp's exact form at 2 x 2 Gauss points each, and shines as a Lambertian rectangle.
// Further bounces: their mean over the room, 1.15 rho^2 Phi/(A (1 - rho)), the same everywhere
// (room_bounce.h: the whole within -20 and +12 % in 500 random boxes).
class WallLight {
 public:
  static constexpr int kFine = 10;
  static constexpr int kCoarse = 4;

  // The lamp must follow a distance (not IsEverywhere); outside the room it counts as just inside.
  WallLight(const RoomBox& room, const PlacedLamp& lamp, int side);

  // First bounce and further ones.                                                      [lx]
  [[nodiscard]] double At(const SurfacePoint& at) const;
  // What they cannot exceed, (1.2 first + 2 tail).                                      [lx]
  [[nodiscard]] double BoundAt(const SurfacePoint& at) const;

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
  double tolerance_;  // of a patch's form
  std::vector<Patch> patches_;
  double tail_ = 0.0;  // rho^2 Phi/(A (1 - rho)) [lx]
};

}  // namespace lightcal
