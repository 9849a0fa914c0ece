// SPDX-License-Identifier: Apache-2.0
// Light that walls, ceiling, floor and furniture throw back from a lamp onto a meter that faces it:
// what is known of it before anything is read.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/light/fixture.h"
#include "lightcal/photometry/light_kind.h"

namespace lightcal {

// E_walls = I b exp(slope x + bend x^2),  x = ln(d / 3 m),  b in lx/cd (1/m^2). ln b and slope are
// normal and independent: three metres from the lamp they are so in traced rooms, at one they lean
// on each other. `scatter`: what a place adds to ln E_walls, 1 sigma.
struct WallPrior {
  double ln_b = 0.0, sd_ln_b = 0.0;
  double slope = 0.0, sd_slope = 0.0;
  double bend = 0.0;
  double scatter = 0.0;
  // A meter turned by theta from the lamp, nobody knows whither, gets 1 + turned (1 - cos theta) of
  // that; 1 sigma of its ln a radian. Half a sphere sees (1 + cos theta)/2 of what a bulb lights
  // all round; the wall that a panel or a beam lights comes into sight.
  double turned = 0.0, sd_turned = 0.3;
};
inline constexpr double kWallReference_m = 3.0;
// 1 sigma of ln E_walls between meters of one place that face elsewhere than the lamp, beside their
// scatter (tests/tools/traced_rooms: tables under bulbs and panels).
inline constexpr double kTurnedScatter = 0.06;

// One thing that the lamp may be, of which one is.
struct WallHypothesis {
  double weight = 1.0;
  WallPrior prior;
  // Of a lamp of unknown kind, or a panel of unknown size: the luminous rectangle it would be, 0 =
  // a point.
  double width_m = 0.0, height_m = 0.0;
  // Of a lamp of unknown make: where the light of one that shines so starts (its weight is not
  // used).
  std::optional<OffsetPart> offset = std::nullopt;
};

// What the lamp may be where no wall shines, of which one is: as in WallHypothesis.
struct LampMake {
  double weight = 1.0;
  double width_m = 0.0, height_m = 0.0;
  std::optional<OffsetPart> offset = std::nullopt;
};

// What is known of where a lamp sends its light.
struct LampSpread {
  LightKind kind = LightKind::kPoint;
  std::optional<Fixture> fixture;
  std::optional<Radians> beam;                // full angle at half the peak
  std::optional<double> flux_over_intensity;  // sr, of a cone or a table
};

// A stated room: a closed box with one mean reflectance, 1 sigma of it.
struct StatedRoom {
  Vec3 size_m{};
  double reflectance = 0.5;
  double reflectance_sigma = 0.05;
};

// What a stated room makes of an ordinary one's light from walls, ln and 1 sigma: (f/.0088)^.7 with
// f = rho/(A (1 - rho)), .0088 being an ordinary room's, by what is not known of rho. A room larger
// than any of these counts as the largest of its shape.
struct RoomPart {
  double ln = 0.0, sd = 0.0;
};
[[nodiscard]] RoomPart PartOfRoom(const StatedRoom& room);

// From 1,500 path-traced ordinary rooms (tests/tools/traced_rooms): b of the lamp's flux over
// intensity, in a stated room b = k flux/I times its part. A room that is larger than all of these,
// by what is stated or because `farthest` is read in it, is such a room s times as large, where
//   E_walls(d) = E_walls of the ordinary room(d/s) / s^2.
// Empty for kinds without a distance.
[[nodiscard]] std::vector<WallHypothesis> WallPriors(const LampSpread& lamp,
                                                     const std::optional<StatedRoom>& room,
                                                     Metres farthest = Metres(0.0));

// Outdoors: what the ground throws back, of lawn, asphalt or sand under a lamp .8 to 3 m above it
// that is read about level.
[[nodiscard]] std::vector<WallHypothesis> GroundPriors(const LampSpread& lamp);

// The same lamps in the dark: each size once, an offset that goes with it where the make is
// unknown. Of an unknown make only sizes that no such lamp's offset makes up for. Empty where no
// size is in question.
[[nodiscard]] std::vector<LampMake> PossibleMakes(const LampSpread& lamp);

// One normal of all that a lamp may be, its bend and scatter the first one's. Absent of none.
[[nodiscard]] std::optional<WallPrior> OneNormalOf(const std::vector<WallHypothesis>& walls);

// Median of E_walls/I at a distance, lx/cd, and the same `deviates` standard deviations above.
[[nodiscard]] double WallsPerCandela(const WallPrior& prior, double distance_m,
                                     double deviates = 0.0);

}  // namespace lightcal
