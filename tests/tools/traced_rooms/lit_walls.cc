// SPDX-License-Identifier: Apache-2.0
#include "lit_walls.h"

#include <algorithm>
#include <cmath>

namespace traced_rooms {
namespace {

constexpr std::uint64_t kSeed = 90210077;
constexpr double kDegree = kPi / 180.0;
constexpr double kOnPaint_m = 1e-4, kFromEdge_m = 0.02;

bool Plain(const Room& room, int wall) {
  return room.glossy_wall != wall && !(room.window && room.window->wall == wall);
}

// Where the lamp is. False: not so.
bool Carry(Random& random, LitWall* out) {
  Room& room = out->lit.room;
  Lamp& lamp = out->lit.lamp;
  const int wall = random.Below(4), across = wall / 2, along = 1 - across;
  const bool far = wall % 2 == 1;
  out->distance = random.Between(0.6, 2.0);
  const double side = random.Between(0.6, std::max(0.6, room.size[along] - 0.6));
  const double height = random.Between(0.8, 1.8);
  if (!Plain(room, wall) || room.size[across] < out->distance + 0.6) return false;
  out->wall = wall;
  lamp.towards = {0, 0, 0};
  lamp.towards[across] = far ? 1.0 : -1.0;
  lamp.place[across] = far ? room.size[across] - out->distance : out->distance;
  lamp.place[along] = side;
  lamp.place[2] = height;
  // Nobody turns a bulb's base to the wall.
  const double from_base = std::acos(std::clamp(Dot(lamp.towards, lamp.base), -1.0, 1.0));
  if (lamp.kind == LampKind::kBulb && from_base < lamp.base_angle + 60.0 * kDegree) return false;
  return std::ranges::none_of(room.boxes, [&](const Box& box) {
    bool outside = false;
    for (int i = 0; i < 3; ++i) {
      outside = outside || lamp.place[i] < box.low[i] - 0.2 || lamp.place[i] > box.high[i] + 0.2;
    }
    return !outside;
  });
}

void AddPlace(double gamma_deg, double azimuth_deg, LitWall* out) {
  const Lamp& lamp = out->lit.lamp;
  const Room& room = out->lit.room;
  const Vec3 up{0, 0, 1}, right = Cross(lamp.towards, up);
  const double reach = (out->distance - kOnPaint_m) * std::tan(gamma_deg * kDegree);
  const Vec3 at = lamp.place + (out->distance - kOnPaint_m) * lamp.towards +
                  reach * std::cos(azimuth_deg * kDegree) * up +
                  reach * std::sin(azimuth_deg * kDegree) * right;
  for (int i = 0; i < 3; ++i) {
    const bool across = std::abs(lamp.towards[i]) > 0.5;
    if (!across && (at[i] < kFromEdge_m || at[i] > room.size[i] - kFromEdge_m)) return;
  }
  if (room.Blocked(lamp.place, at)) return;
  out->places.push_back({gamma_deg, azimuth_deg, {at, -1.0 * lamp.towards, 0.0, lamp.towards}});
}

}  // namespace

LitWall LitWallOf(Family family, int number) {
  Random random(kSeed + 1000003ULL * number + (family == Family::kUnseen ? 17 : 0));
  LitWall out;
  out.lit = RandomRoom(family, number);
  for (int attempt = 0; attempt < 200; ++attempt) {
    if (!Carry(random, &out)) continue;
    out.places.clear();
    AddPlace(0.0, 0.0, &out);
    if (out.places.empty()) continue;
    for (const double gamma : {10.0, 20.0, 30.0, 40.0}) {
      for (int k = 0; k < 12; ++k) AddPlace(gamma, 30.0 * k, &out);
    }
    constexpr std::size_t kFewest = 30;
    if (out.places.size() >= kFewest) return out;
  }
  out.places.clear();
  return out;
}

}  // namespace traced_rooms
