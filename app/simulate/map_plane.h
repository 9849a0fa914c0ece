// SPDX-License-Identifier: Apache-2.0
// The plane that a map is drawn of, from what a person types.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/light/illuminance_map.h"

namespace lightcal::app {

struct MapPlane {
  PlaneGrid grid;
  std::string name;                                         // "floor", "z = 0.8 m", "wall x = -2 m"
  std::string across_axis, up_axis;                         // "x", "y", "z"
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;  // the picture's edges [m]
};

struct MapPlaneWords {
  std::string plane;   // floor, z=0.8, x=-2, y=1.5
  std::string grid;    // "512": the longer side; "512x256"
  std::string size;    // "6m", "6x4m"; "" = the room's, or around the lamps
  std::string center;  // "1,2" in the plane's two coordinates; "" = the room's or the lamps' middle
};

// Seen from the side the light falls on, walls upright, floors and ceilings as a plan with +y up. A
// plane z faces the lamps: up unless all of them hang below it. Without a room or a size it reaches
// four times the lamps' height beyond their feet.   Wrong usage: words that cannot be read.
[[nodiscard]] Result<MapPlane> ReadMapPlane(const MapPlaneWords& words,
                                            const std::vector<PlacedLamp>& lamps,
                                            const std::optional<RoomBox>& room);

// A point of the map in the plane's own two coordinates.
[[nodiscard]] Vec3 PointOf(const MapPlane& plane, int i, int j);

}  // namespace lightcal::app
