// SPDX-License-Identifier: Apache-2.0
// The lamp's own light, back from the walls. Lamp-off readings do not remove it; a shadow card
// does.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightcal/light/effects/effect.h"
#include "lightcal/light/room_bounce.h"

namespace lightcal::effects {

// Median of indirect over direct in 500 random boxes (reflectance 0.1-0.85, 0.3-3 m).
inline constexpr double kBounceDefault = 0.25;

// Price of the walls' light as a fitted parameter, for one reading.
inline constexpr double kFittedWalls_ns = 16.0;

// What the walls add per candela in 19 of 20 rooms.
[[nodiscard]] inline double MostWallLight(const std::vector<WallHypothesis>& walls,
                                          double distance_m) {
  constexpr double kDeviates = 1.645;
  double most = 0.0;
  for (const WallHypothesis& one : walls) {
    most = std::max(most, WallsPerCandela(one.prior, distance_m, kDeviates));
  }
  return most;
}

// Whether every reading has its shadow-card reading.
[[nodiscard]] inline bool AllBehindCards(const Scene& scene) {
  return std::all_of(scene.poses.begin(), scene.poses.end(),
                     [](const ScenePose& pose) { return pose.differenced; });
}

// A card hides the wall behind the lamp too: light that the difference takes for the lamp's own,
// over the direct light. It is nearly the same at every distance, as the card's solid angle falls
// like the lamp's light. The most, and the root mean square, of 1,500 traced rooms with a card half
// way (tests/tools/traced_rooms: (wall - card)/direct; bulbs, panels, beams).
struct CardShade {
  double most = 0.0, rms = 0.0;
};
[[nodiscard]] inline CardShade CardShadeOf(const Scene& scene) {
  if (scene.kind == LightKind::kSpot || scene.beam) return {0.002, 0.0004};
  if (scene.kind == LightKind::kDisk || scene.kind == LightKind::kRect) return {0.021, 0.0024};
  return {0.055, 0.010};
}

// A fit takes them up under the prior of light/wall_prior.h; behind cards CardShade. Elsewhere
//   bound = (1.35 E1 + 2 tail)/E_direct at its worst reading, 1.5 and 6 for a lamp with a lobe; E1
//   the first bounce and tail the further ones (light/room_bounce.h)
[[nodiscard]] inline EffectFinding FindRoomBounce(const Scene& scene) {
  if (AllBehindCards(scene) && FollowsDistance(scene) && !scene.no_walls) {
    const CardShade shade = CardShadeOf(scene);
    return {.bound = shade.most,
            .treatment = Treatment::kWidens,
            .reason = "the shadow-card readings subtract it, but for the wall that the card hides",
            .sd = shade.rms,
            .own_lamp = true,
            .part = "shadow_card"};
  }
  if (!FollowsDistance(scene)) {
    return NotApplicable("part of what this kind of light is");
  }
  if (scene.no_walls) {
    return NotApplicable(
        "no walls: [room] says dark, cards subtract the ground's light outdoors, or the figures "
        "are "
        "a data sheet's");
  }
  if (!scene.walls.empty()) {
    double bound = 0.0;
    for (const ScenePose& pose : scene.poses) {
      if (pose.differenced) continue;
      bound = std::max(bound, MostWallLight(scene.walls, pose.distance_m) * pose.distance_m *
                                  pose.distance_m / std::cos(pose.tilt_rad));
    }
    return {.bound = bound,
            .treatment = Treatment::kFitted,
            .distance_power = 2.0,
            .reason = std::string(scene.over_ground ? "what the ground adds outdoors"
                                  : scene.room      ? "what the [room] given adds"
                                                    : "what an ordinary room adds") +
                      " at the worst reading, in 19 of 20; fitted under its prior, and a "
                      "shadow-card reading measures it",
            .cost_ns = kFittedWalls_ns};
  }
  if (!scene.room) {
    return {
        kBounceDefault, Treatment::kWidens, 2.0,
        "no [room] given; indoors the walls add 25 % in the median; a shadow-card reading cancels "
        "it"};
  }
  double bound = 0.0;
  for (const ScenePose& pose : scene.poses) {
    if (!pose.differenced) bound = std::max(bound, BounceAt(scene, pose).RelativeBound(pose));
  }
  return {bound, Treatment::kModelled, 2.0,
          "first bounce from 6 x 36 patches of the [room] and the mean of the further ones"};
}

}  // namespace lightcal::effects
