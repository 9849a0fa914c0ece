// SPDX-License-Identifier: Apache-2.0
// One lamp over one tile of a map: the gate, region by region. Used by illuminance_map.cc alone.
#pragma once

#include <vector>

#include "lightcal/light/lamp_over_plane.h"
#include "lightcal/light/predicted_lamp.h"

namespace lightcal {

inline constexpr int kTile = 64;  // points along a side that are decided on together at first
// From the points a bound was taken at to the region they stand for.
inline constexpr double kFieldMargin = 1.25;

struct TileOutput {
  const Plane& plane;
  IlluminanceMap& map;  // added to
  LampAccount& account;
};

// kGate: decided for each tile; kNever: left off, at most `left_off` of direct light.
struct BounceChoice {
  EffectChoice choice = EffectChoice::kNever;
  double left_off = 0.0;
  double most_lx = 0.0;  // kGate: what the walls' light cannot exceed anywhere on the plane
};

// Where the walls' light over direct light is looked at: corners, middles of the sides, the middle,
// and the points nearest to where the lamp lights the walls most.
[[nodiscard]] std::vector<SurfacePoint> BoundPoints(const PredictedLamp& lamp, const Plane& plane,
                                                    const PixelTile& region);

void WorkTile(const PredictedLamp& lamp, const LampOverPlane& over, const MapSettings& settings,
              const PixelTile& tile, BounceChoice bounce, const TileOutput& out);

}  // namespace lightcal
