// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/wall_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lightcal/core/uncertain.h"
#include "lightcal/light/room_bounce.h"

namespace lightcal {
namespace {

constexpr double kLampInside = 0.05;  // metres between a lamp and the wall it was moved from
constexpr double kTouching = 1e-4;
constexpr int kFineSide = 10, kCoarseSide = 6;
constexpr double kFineTolerance = 3e-3, kCoarseTolerance = 5e-2;
constexpr double kFurtherTolerance = 1e-2;  // of patches that are about alike

Vec3 Clamped(Vec3 p, const RoomBox& room, double margin) {
  for (int axis = 0; axis < 3; ++axis) {
    const double gap = std::min(margin, 0.25 * room.size_m[axis]);
    const double low = LowEnd(room.size_m, axis);
    p[axis] = std::clamp(p[axis], low + gap, low + room.size_m[axis] - gap);
  }
  return p;
}

// Edges of patches along one side, graded about `foot` with the lamp's height over the wall.
std::vector<double> Grade(double low, double high, double foot, double height, int side) {
  std::vector<double> edges;
  const double from = std::asinh((low - foot) / height);
  const double to = std::asinh((high - foot) / height);
  for (int i = 0; i <= side; ++i) {
    edges.push_back(foot + height * std::sinh(from + (to - from) * i / side));
  }
  return edges;
}

// Mean over a rectangle of half sides `along`, `across` about a wall's point.
double MeanLux(const PlacedLamp& lamp, const SurfacePoint& middle, const Vec3& along,
               const Vec3& across) {
  double sum = 0.0;
  for (const double s : GaussLegendre<2>::kNode) {
    for (const double t : GaussLegendre<2>::kNode) {
      const SurfacePoint at{middle.position_m + along * s + across * t, middle.normal};
      sum += 0.25 * LuxOf(lamp, at, {false, kFineTolerance});
    }
  }
  return sum;
}

// As a disk: r^2 + A/pi instead of r^2. Nearer than four of its sides a patch is the rectangle it
// is: of a wall beside the meter a disk is up to four times too dim.
double RoughLuxPerCandela(const RectSource& patch, const Receiver<double>& at) {
  constexpr double kNearSides = 4.0;
  const double d2 = Dot(at.position, at.position);
  const double area = 4.0 * patch.half_width * patch.half_height;
  if (d2 < kNearSides * kNearSides * area) return LuxPerCandela(patch, at, kCoarseTolerance);
  const double toward = -Dot(at.normal, at.position);
  if (!(toward > 0.0) || !(at.position[2] > 0.0)) return 0.0;
  return toward * at.position[2] / (d2 * (d2 + area / std::numbers::pi));
}

}  // namespace

WallLight WallLight::Fine(const RoomBox& room, const PlacedLamp& lamp,
                          const RoomExchange& exchange) {
  WallLight out(room, lamp, Detail::kFine);
  out.AddFurther(exchange);
  return out;
}
WallLight WallLight::Coarse(const RoomBox& room, const PlacedLamp& lamp) {
  return {room, lamp, Detail::kCoarse};
}

WallLight::WallLight(const RoomBox& room, const PlacedLamp& lamp, Detail detail)
    : room_(room), detail_(detail) {
  const int side = detail == Detail::kFine ? kFineSide : kCoarseSide;
  PlacedLamp inside = lamp;
  inside.pose.position_m = Clamped(lamp.pose.position_m, room, kLampInside);
  patches_.reserve(static_cast<std::size_t>(6 * side * side));
  for (const RoomWall& wall : kRoomWalls) AddWall(inside, wall, side);
  const double rho = room.reflectance;
  const double solid_angle = SolidAngleOf(lamp.source);
  tail_ = rho * rho * lamp.strength * solid_angle / (AreaOfWalls_m2(room.size_m) * (1.0 - rho));
  even_ = solid_angle > 4.0 * std::numbers::pi * (1.0 - 1e-9);
}

void WallLight::AddWall(const PlacedLamp& lamp, const RoomWall& wall, int side) {
  const Vec3& from = lamp.pose.position_m;
  const double height = std::abs(from[wall.axis] - wall.at_m(room_.size_m));
  const auto edges = [&](int along) {
    const double low = LowEnd(room_.size_m, along);
    return Grade(low, low + room_.size_m[along], from[along], height, side);
  };
  for (const WallPatch& patch : PatchesOf(wall, room_.size_m, edges(wall.u()), edges(wall.v()))) {
    const SurfacePoint middle = patch.middle();
    Vec3 along{};
    along[wall.u()] = patch.source.half_width;
    Vec3 across{};
    across[wall.v()] = patch.source.half_height;
    const double lux = detail_ == Detail::kCoarse ? LuxOf(lamp, middle, {false, kCoarseTolerance})
                                                  : MeanLux(lamp, middle, along, across);
    Shine(patch, lux, kFineTolerance);
  }
}

void WallLight::Shine(const WallPatch& patch, double lux, double tolerance) {
  const double candela = room_.reflectance * lux * patch.area_m2() / std::numbers::pi;
  if (candela > 0.0) patches_.push_back({patch, candela, tolerance});
}

// What once came back from the walls lights them again, and so on.
void WallLight::AddFurther(const RoomExchange& exchange) {
  const double rho = room_.reflectance;
  if (!(rho > 0.0)) return;
  std::vector<double> once;
  for (std::size_t i = 0; i < exchange.patches().size(); ++i) {
    once.push_back(Sum(Inside(exchange.patches()[i].middle())));
  }
  const std::vector<double> all = exchange.Settled(std::move(once), tail_ * (1.0 - rho) / rho);
  for (std::size_t i = 0; i < all.size(); ++i)
    Shine(exchange.patches()[i], all[i], kFurtherTolerance);
}

SurfacePoint WallLight::Inside(const SurfacePoint& at) const {
  return {Clamped(at.position_m, room_, kTouching), at.normal};
}

double WallLight::Sum(const SurfacePoint& at) const {
  double sum = 0.0;
  for (const auto& [patch, candela, tolerance] : patches_) {
    const Receiver<double> receiver = patch.Seen(at);
    sum +=
        candela * (detail_ == Detail::kCoarse ? RoughLuxPerCandela(patch.source, receiver)
                                              : LuxPerCandela(patch.source, receiver, tolerance));
  }
  return sum;
}

double WallLight::At(const SurfacePoint& at) const { return Sum(Inside(at)); }

double WallLight::BoundAt(const SurfacePoint& at) const {
  return MostBounce(Sum(Inside(at)), tail_, even_);
}

double WallLight::u95_relative() const { return kZ95 * BounceSigma(even_); }

}  // namespace lightcal
