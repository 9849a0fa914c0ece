// SPDX-License-Identifier: Apache-2.0
// Light from the walls at meters that face a lamp, by tracing the lamp's light forwards.
#pragma once

#include <vector>

#include "lamp.h"
#include "room.h"

namespace traced_rooms {

struct Meter {
  Vec3 place, normal;
  double card_distance = 0.0;  // of its shadow card from the lamp; 0: it has none
  Vec3 from_lamp{};            // unit, from the lamp to the meter: across it stands the card
};

// A cosine receiver at each distance along lamp.towards, facing the lamp, its card half way.
std::vector<Meter> MetersAlong(const Lamp& lamp, const std::vector<double>& distances);

struct WallLight {
  double wall = 0.0;         // lx per cd towards the meter, all that is not direct
  double behind_card = 0.0;  // the same with a black card in the direct light
  double error = 0.0;        // standard error of `wall` over `wall`
};

struct TraceAnswer {
  std::vector<WallLight> meters;
  double absorbed = 0.0;  // of all light emitted, by the surfaces: 1 but for noise
};

struct TraceEffort {
  double relative_error = 0.008;  // of every meter's `wall` ...
  long least = 1 << 15;
  long most = 1 << 20;  // ... or this many rays of light
};

// Rays of light bounce until they are absorbed; wherever one meets a diffuse surface, its light is
// sent on to every meter that the surface sees (next-event estimation), directly and by way of the
// glossy wall. A meter, its card (but for its shadow) and its reader reflect nothing and hide
// nothing. The lamp itself hides nothing.
TraceAnswer TraceLight(const Room& room, const Lamp& lamp, const std::vector<Meter>& meters,
                       const TraceEffort& effort, Random& random);

// `wall` of one meter by the opposite way, from the meter to the lamp, as a check. No glossy wall,
// no panel.
WallLight TraceBackwards(const Room& room, const Lamp& lamp, const Meter& meter, long paths,
                         Random& random);

}  // namespace traced_rooms
