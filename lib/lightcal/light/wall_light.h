// SPDX-License-Identifier: Apache-2.0
// A room's walls as lamps: what one lamp lights up on them, thrown back onto any surface inside.
#pragma once

#include <cstdint>
#include <vector>

#include "lightcal/light/placed_lamp.h"
#include "lightcal/light/room_exchange.h"
#include "lightcal/light/scene.h"
#include "lightcal/light/wall_patch.h"

namespace lightcal {

// First bounce: each wall is cut into patches, graded by asinh about the lamp's foot. Further
// bounces: the radiosity of the box (room_exchange.h), their mean over its walls
// rho^2 Phi/(A (1 - rho)); of bounds that mean alone (room_bounce.h).
class WallLight {
 public:
  // For values: 10 x 10 patches a wall, each lit at 2 x 2 Gauss points and shining as a Lambertian
  // rectangle, and the room's own for the further bounces.
  // For bounds, at a sixth of the price: 6 x 6, each lit at its middle and shining as a disk,
  // those about the point as rectangles.
  // The lamp must follow a distance (not IsEverywhere); outside the room it counts as just inside.
  [[nodiscard]] static WallLight Fine(const RoomBox& room, const PlacedLamp& lamp,
                                      const RoomExchange& exchange);
  [[nodiscard]] static WallLight Coarse(const RoomBox& room, const PlacedLamp& lamp);

  // First bounce and further ones, of fine walls.                                       [lx]
  [[nodiscard]] double At(const SurfacePoint& at) const;
  // What they cannot exceed (MostBounce), of coarse ones.                               [lx]
  [[nodiscard]] double BoundAt(const SurfacePoint& at) const;
  // 95 % interval of At, relative.
  [[nodiscard]] double u95_relative() const;

 private:
  enum class Detail : std::uint8_t { kFine, kCoarse };
  struct Patch {
    WallPatch wall;
    double candela = 0.0;
    double tolerance = 0.0;  // relative, of its light at a point
  };
  WallLight(const RoomBox& room, const PlacedLamp& lamp, Detail detail);
  void Shine(const WallPatch& patch, double lux, double tolerance);
  void AddWall(const PlacedLamp& lamp, const RoomWall& wall, int side);
  [[nodiscard]] SurfacePoint Inside(const SurfacePoint& at) const;
  void AddFurther(const RoomExchange& exchange);
  // Of all patches.
  [[nodiscard]] double Sum(const SurfacePoint& at) const;

  RoomBox room_;
  Detail detail_;
  std::vector<Patch> patches_;
  double tail_ = 0.0;  // rho^2 Phi/(A (1 - rho)) [lx]
  bool even_ = true;   // the lamp shines alike in all directions
};

}  // namespace lightcal
