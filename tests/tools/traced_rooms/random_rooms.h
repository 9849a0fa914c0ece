// SPDX-License-Identifier: Apache-2.0
// Two families of random rooms with a lamp in each; the same on every machine, by number.
#pragma once

#include <string_view>
#include <vector>

#include "lamp.h"
#include "room.h"
#include "trace.h"

namespace traced_rooms {

enum class Family {
  // 3-8 x 3-7 x 2.4-3.4 m, walls .25-.8, floor .1-.45, ceiling .5-.85, 0-5 boxes as furniture.
  kOrdinary,
  // Each has at least one of: L-shaped, a window (black glass or a white blind), a glossy wall, the
  // lamp in a corner. Priors are chosen on the other family.
  kUnseen,
  // Rooms of the ordinary kind with three lamps in each, number 3 n + k being the k-th of room n.
  // Every meter has its 3 m.
  kThreeLamps,
  // Rooms of the ordinary kind, the lamp where people put lamps: .15 to 2 m from the nearer wall of
  // each pair, every factor as often as another; bulbs that hang .15 m to half the height below the
  // ceiling.
  kByWalls,
};
std::string_view NameOf(Family family);

struct LitRoom {
  Room room;
  Lamp lamp;
  double reach = 3.0;  // m: how far along lamp.towards a meter can stand
  bool l_shaped = false, corner = false;
};

// Room `number` of a family: bulb, panel, beam in turn.
LitRoom RandomRoom(Family family, int number);

// How a lamp is read whose place is sought.
enum class Layout {
  kFacing,  // anywhere in the room, the meter turned to the lamp
  kTable,   // flat on tables .76 m high, the lamp at least .6 m above them
};
std::string_view NameOf(Layout layout);
// Seven places about the lamp of such a room, half a metre to 2.5 m from it and in its light (a
// bulb: three quarters of what it sends its first meter; a panel: three tenths), .2 m from
// everything, each with a card half way. Empty: the room has no such seven.
std::vector<Meter> PlacesAround(const LitRoom& lit, Layout layout, int number);

// Metres from the lamp at which the table has readings; those beyond `reach` are left out.
inline const std::vector<double> kDistances = {0.5, 0.7, 1.0, 1.5, 2.0, 3.0};

}  // namespace traced_rooms
