// SPDX-License-Identifier: Apache-2.0
// What is known of one lamp and its readings before any fit: the input of every effect's bound.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/light/axial_shape.h"
#include "lightcal/photometry/light_kind.h"

namespace lightcal {

// A grey box of a room. The origin lies on the floor under its middle, Z up.
struct RoomBox {
  Vec3 size_m{};
  double reflectance = 0.5;
  int bounce_patches = 6;  // along each side of each wall, where light bounces
};

// Where one reading was taken.
struct ScenePose {
  double distance_m = 1.0;
  double tilt_rad = 0.0;
  bool from_center = false;  // distance between two known positions: holds no offset
  bool differenced = false;  // shadow card subtracted: no ambient light, no bounce
  std::optional<Vec3> position_m;
};

struct Scene {
  LightKind kind = LightKind::kPoint;
  SourceSize size;
  std::optional<Vec3> position_m;
  std::optional<Vec3> aim;
  std::optional<Radians> inner, outer;  // half angles
  std::optional<Radians> beam;          // full angle at half the peak
  std::vector<ScenePose> poses;         // readings with the lamp on, at least one
  int distances = 1;                    // distinct
  std::optional<double> ambient_ratio;  // lamp-off illuminance over the dimmest reading
  std::optional<RoomBox> room;
  std::optional<double> spectral_f1;  // of the worst meter that states it, fraction
  std::optional<double> cosine_f2;
  std::optional<Metres> head_radius;
};

[[nodiscard]] double NearestDistance(const Scene& scene);
[[nodiscard]] double FarthestDistance(const Scene& scene);
[[nodiscard]] double LargestTilt(const Scene& scene);
// Whether the light follows a distance at all.
[[nodiscard]] bool FollowsDistance(const Scene& scene);
// The radius around the axis that the source fills: half its largest side; absent when unknown.
[[nodiscard]] std::optional<double> SourceRadius(const Scene& scene);

}  // namespace lightcal
