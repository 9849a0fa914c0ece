// SPDX-License-Identifier: Apache-2.0
// A lamp turned to a wall that somebody photographs to see its beam; the same on every machine, by
// number.
#pragma once

#include <vector>

#include "random_rooms.h"

namespace traced_rooms {

// A place on the lit wall, seen from the lamp `gamma_deg` off the wall's normal and, clockwise as
// the lamp looks, `azimuth_deg` from straight up.
struct WallPlace {
  double gamma_deg = 0.0, azimuth_deg = 0.0;
  Meter meter;  // on the paint
};

struct LitWall {
  LitRoom lit;            // the lamp faces the wall, straight
  double distance = 0.0;  // m
  int wall = 0;           // room.albedo's number of it
  std::vector<WallPlace> places;
};

// Room `number` of a family with its lamp carried .6 to 2 m before a plain wall (no window, no
// gloss), .6 m or more from all other walls and with nothing between. The middle, and 12 azimuths
// at 10, 20, 30, 40 degrees where the wall reaches so far. No places: not so in this room.
LitWall LitWallOf(Family family, int number);

}  // namespace traced_rooms
