// SPDX-License-Identifier: Apache-2.0
#include "random_rooms.h"

#include <algorithm>

namespace traced_rooms {
namespace {

constexpr std::uint64_t kOrdinarySeed = 20261122;
constexpr std::uint64_t kUnseenSeed = 77003141;
constexpr std::uint64_t kByWallsSeed = 30081999;
// m between a lamp that stands by walls and each of them.
constexpr double kLeastFromWall = 0.15, kMostFromWall = 2.0;
constexpr double kFree = 0.2;  // m between a meter or a lamp and any surface

// Whether the way from the lamp to `to` keeps clear of walls, from `first` of its 60 parts on, and
// of furniture.
bool Clear(const Room& room, const Vec3& from, const Vec3& to, int first = 1) {
  for (int step = 0; step <= 60; ++step) {
    const Vec3 at = from + (step / 60.0) * (to - from);
    for (int i = 0; i < 3; ++i) {
      if (step >= first && (at[i] < kFree || at[i] > room.size[i] - kFree)) return false;
    }
    for (const Box& box : room.boxes) {
      bool outside = false;
      for (int i = 0; i < 3; ++i) {
        outside = outside || at[i] < box.low[i] - kFree || at[i] > box.high[i] + kFree;
      }
      if (!outside) return false;
    }
  }
  return true;
}

void PaintRoom(Random& random, Room* room) {
  room->size = {random.Between(3.0, 8.0), random.Between(3.0, 7.0), random.Between(2.4, 3.4)};
  const double walls = random.Between(0.25, 0.8);
  for (int wall = 0; wall < 4; ++wall) {
    room->albedo[wall] = std::clamp(walls + random.Between(-0.08, 0.08), 0.25, 0.8);
  }
  room->albedo[4] = random.Between(0.1, 0.45);
  room->albedo[5] = random.Between(0.5, 0.85);
}

void AddFurniture(Random& random, Room* room) {
  const int count = random.Below(6);
  for (int i = 0; i < count; ++i) {
    Box box;
    const Vec3 sides = {random.Between(0.4, 1.8), random.Between(0.4, 1.8),
                        random.LogBetween(0.4, 2.1)};
    for (int k = 0; k < 2; ++k) {
      box.low[k] = random.Between(0.0, room->size[k] - sides[k]);
      // Two in three stand at a wall.
      if (random.Share() < 0.4) box.low[k] = random.Share() < 0.5 ? 0.0 : room->size[k] - sides[k];
    }
    box.low[2] = 0.0;
    box.high = box.low + sides;
    box.albedo = random.Between(0.1, 0.7);
    room->boxes.push_back(box);
  }
}

void AddLShape(Random& random, Room* room) {
  Box corner;
  for (int k = 0; k < 2; ++k) {
    const double side = room->size[k] * random.Between(0.25, 0.5);
    corner.low[k] = random.Share() < 0.5 ? 0.0 : room->size[k] - side;
    corner.high[k] = corner.low[k] + side;
  }
  corner.low[2] = 0.0;
  corner.high[2] = room->size[2];
  corner.albedo = room->albedo[0];
  room->boxes.push_back(corner);
}

void AddWindow(Random& random, Room* room) {
  Window window;
  window.wall = random.Below(4);
  const int along = 1 - window.wall / 2;
  const double width = random.Between(0.25, 0.8) * room->size[along];
  const double left = random.Between(0.0, room->size[along] - width);
  window.low = {0, 0, random.Between(0.1, 1.0)};
  window.high = room->size;
  window.low[along] = left;
  window.high[along] = left + width;
  window.high[2] = room->size[2] - random.Between(0.1, 0.5);
  window.albedo = random.Share() < 0.6 ? random.Between(0.04, 0.12) : random.Between(0.65, 0.85);
  room->window = window;
}

void AddGloss(Random& random, Room* room) {
  room->glossy_wall = random.Below(4);
  room->glossy_f0 = random.LogBetween(0.04, 0.3);  // lacquer to metal paint
}

enum class Standing { kAnywhere, kInCorner, kByWalls };

// Nearer to the one wall of a pair or to the other.
double FromWall(Random& random, double side) {
  const double near = random.LogBetween(kLeastFromWall, std::min(kMostFromWall, 0.5 * side));
  return random.Share() < 0.5 ? near : side - near;
}

// Where the lamp is, and which way its meter stands. False: not so in this room.
bool PlaceLamp(Random& random, Standing standing, LitRoom* lit) {
  const Room& room = lit->room;
  Lamp& lamp = lit->lamp;
  const bool in_corner = standing == Standing::kInCorner;
  const bool by_walls = standing == Standing::kByWalls;
  const bool down = !in_corner && random.Share() < 0.15;
  const double from_wall = in_corner ? 0.25 : 0.45;
  for (int k = 0; k < 2; ++k) {
    const double near = random.Between(0.22, 0.4);
    lamp.place[k] = random.Between(from_wall, room.size[k] - from_wall);
    if (in_corner) lamp.place[k] = random.Share() < 0.5 ? near : room.size[k] - near;
    if (by_walls) lamp.place[k] = FromWall(random, room.size[k]);
  }
  double lowest = 0.0, highest = 0.0;  // elevation of the meter's line, degrees
  if (lamp.kind == LampKind::kBulb) {
    const bool pendant = random.Share() < 0.6;
    lamp.place[2] =
        pendant || down ? room.size[2] - random.Between(0.25, 0.9) : random.Between(0.6, 1.6);
    if (by_walls && (pendant || down)) {
      lamp.place[2] = room.size[2] - random.LogBetween(kLeastFromWall, 0.5 * room.size[2]);
    }
    lowest = pendant ? -45.0 : -15.0;
    highest = pendant ? 0.0 : 20.0;
    lamp.base = {0, 0, pendant || down ? 1.0 : -1.0};
    if (random.Share() < 0.2) {  // screwed in sideways
      const double turn = random.Between(0.0, 2.0 * kPi);
      lamp.base = {std::cos(turn), std::sin(turn), 0.0};
    }
    lamp.base_angle = random.Between(15.0, 50.0) * kPi / 180.0;
    lamp.slope = random.Between(-0.1, 0.5);
  } else {
    lamp.place[2] = down ? room.size[2] - 0.05 : random.Between(0.7, room.size[2] - 0.4);
    lowest = lamp.place[2] > 1.6 ? -35.0 : -10.0;
    highest = lamp.place[2] > 1.6 ? 5.0 : 15.0;
    if (lamp.kind == LampKind::kPanel) {
      lamp.width = random.LogBetween(0.1, 0.5);
      lamp.height = lamp.width * random.Between(0.5, 1.0);
    } else {
      lamp.power = random.LogBetween(3.0, 60.0);
    }
  }
  const double azimuth = random.Between(0.0, 2.0 * kPi);
  const double elevation = down ? -kPi / 2.0 : random.Between(lowest, highest) * kPi / 180.0;
  lamp.towards = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                  std::sin(elevation)};
  if (down) lamp.towards = {0, 0, -1};
  // Nobody reads a bulb from behind its base.
  if (lamp.kind == LampKind::kBulb && Dot(lamp.towards, lamp.base) > 0.0 &&
      std::acos(Dot(lamp.towards, lamp.base)) < lamp.base_angle + 20.0 * kPi / 180.0) {
    return false;
  }
  lit->reach = 0.0;
  for (const double d : kDistances) {
    // Walls are plane: where lamp and meter keep clear of them, so does what is between.
    const Vec3 meter = lamp.place + d * lamp.towards;
    if (Clear(room, lamp.place, meter, by_walls ? 60 : 1)) lit->reach = d;
  }
  return lit->reach >= (down ? 1.5 : 2.0);
}

constexpr std::uint64_t kThreeLampsSeed = 51290017;
constexpr int kLamps = 3;

// Paints rooms until all three lamps of one have their 3 m.
LitRoom OneOfThree(int number) {
  const std::uint64_t seed = kThreeLampsSeed + 1000003ULL * (number / kLamps);
  for (std::uint64_t attempt = 0;; ++attempt) {
    Random random(seed + 7919ULL * attempt);
    Room room;
    PaintRoom(random, &room);
    AddFurniture(random, &room);
    LitRoom wanted;
    int placed = 0;
    for (int k = 0; k < kLamps; ++k) {
      LitRoom lit;
      lit.room = room;
      lit.lamp.kind = static_cast<LampKind>(k);
      bool fits = false;
      for (int again = 0; again < 60 && !fits; ++again) {
        fits = PlaceLamp(random, Standing::kAnywhere, &lit) && lit.reach >= 3.0;
      }
      placed += fits ? 1 : 0;
      if (k == number % kLamps) wanted = lit;
    }
    if (placed == kLamps) return wanted;
  }
}

}  // namespace

std::string_view NameOf(Family family) {
  constexpr std::string_view kNames[] = {"ordinary", "unseen", "three_lamps", "by_walls"};
  return kNames[static_cast<int>(family)];
}

LitRoom RandomRoom(Family family, int number) {
  if (family == Family::kThreeLamps) return OneOfThree(number);
  const bool unseen = family == Family::kUnseen;
  const bool by_walls = family == Family::kByWalls;
  Random random((unseen ? kUnseenSeed : (by_walls ? kByWallsSeed : kOrdinarySeed)) +
                1000003ULL * number);
  for (;;) {
    LitRoom lit;
    lit.lamp.kind = static_cast<LampKind>(number % 3);
    PaintRoom(random, &lit.room);
    AddFurniture(random, &lit.room);
    if (unseen) {
      lit.l_shaped = random.Share() < 0.45;
      lit.corner = random.Share() < 0.4;
      const bool window = random.Share() < 0.5;
      const bool gloss = random.Share() < 0.4;
      if (!lit.l_shaped && !lit.corner && !window && !gloss) continue;
      if (lit.l_shaped) AddLShape(random, &lit.room);
      if (window) AddWindow(random, &lit.room);
      if (gloss) AddGloss(random, &lit.room);
    }
    const Standing standing = by_walls     ? Standing::kByWalls
                              : lit.corner ? Standing::kInCorner
                                           : Standing::kAnywhere;
    // Most lines are read to 3 m, as far as the room has the place.
    for (int attempt = 0; attempt < 60; ++attempt) {
      if (PlaceLamp(random, standing, &lit) && (lit.reach >= 3.0 || attempt > 20)) return lit;
    }
  }
}

std::string_view NameOf(Layout layout) { return layout == Layout::kFacing ? "facing" : "table"; }

std::vector<Meter> PlacesAround(const LitRoom& lit, Layout layout, int number) {
  constexpr std::uint64_t kPlacesSeed = 41760229;
  constexpr std::size_t kPlaces = 7;
  constexpr double kTable_m = 0.76, kLeastAbove_m = 0.6, kNearest_m = 0.5, kFarthest_m = 2.5;
  const bool table = layout == Layout::kTable;
  Random random(kPlacesSeed + 1000003ULL * number + (table ? 1 : 0));
  std::vector<Meter> meters;
  if (table && lit.lamp.place[2] < kTable_m + kLeastAbove_m) return meters;
  const double least_part = lit.lamp.kind == LampKind::kBulb ? 0.75 : 0.3;
  for (int attempt = 0; attempt < 20000 && meters.size() < kPlaces; ++attempt) {
    const Vec3 at = {random.Between(kFree, lit.room.size[0] - kFree),
                     random.Between(kFree, lit.room.size[1] - kFree),
                     table ? kTable_m : random.Between(0.3, 2.0)};
    const Vec3 way = at - lit.lamp.place;
    const double distance = Length(way);
    if (distance < kNearest_m || distance > kFarthest_m) continue;
    const Vec3 from_lamp = (1.0 / distance) * way;
    if (lit.lamp.Intensity(from_lamp) < least_part || (table && from_lamp[2] > -0.3)) continue;
    if (!Clear(lit.room, lit.lamp.place, at)) continue;
    meters.push_back({at, table ? Vec3{0, 0, 1} : -1.0 * from_lamp, 0.5 * distance, from_lamp});
  }
  if (meters.size() < kPlaces) meters.clear();
  return meters;
}

}  // namespace traced_rooms
