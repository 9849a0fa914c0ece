// SPDX-License-Identifier: Apache-2.0
// What is known of one lamp and its readings before any fit: the input of every effect's bound.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/light/axial_shape.h"
#include "lightcal/light/fixture.h"
#include "lightcal/light/wall_prior.h"
#include "lightcal/photometry/light_kind.h"

namespace lightcal {

// A grey box of a room. The origin lies on the floor under its middle, Z up.
struct RoomBox {
  Vec3 size_m{};
  double reflectance = 0.5;
  int bounce_patches = 6;  // along each side of each wall, where light bounces
};

// Where its low wall across an axis stands, origin under its middle.                     [m]
[[nodiscard]] inline double LowEnd(const Vec3& size_m, int axis) {
  return axis == 2 ? 0.0 : -0.5 * size_m[axis];
}

[[nodiscard]] inline double AreaOfWalls_m2(const Vec3& size_m) {
  return 2.0 * (size_m[0] * size_m[1] + size_m[1] * size_m[2] + size_m[2] * size_m[0]);
}

// Whether p lies in the room, origin under its middle; 1 cm beyond is still in it: a meter on the
// floor, a lamp at the wall.
[[nodiscard]] inline bool IsInRoom(const Vec3& p, const Vec3& size_m) {
  constexpr double kSlack = 0.01;
  const bool level =
      std::abs(p[0]) <= 0.5 * size_m[0] + kSlack && std::abs(p[1]) <= 0.5 * size_m[1] + kSlack;
  return level && p[2] >= -kSlack && p[2] <= size_m[2] + kSlack;
}

// Where one reading was taken.
struct ScenePose {
  double distance_m = 1.0;
  double tilt_rad = 0.0;
  bool from_center = false;  // distance between two known positions: holds no offset
  bool differenced = false;  // shadow card subtracted: no ambient light, no bounce
  std::optional<Vec3> position_m;
  // Between the source's axis and the meter, where lamp, aim and meter are placed (a tube: out of
  // the plane square to it); 0 on the axis.
  double emission_rad = 0.0;
  bool of_luminance = false;  // from a picture of the lamp itself: nothing else shines in it
  // Of a lamp with a table: how far it may lie from the lamp's own lobe there, relative.
  double table_error = 0.0;
};

// The lamp in time, and how long one reading gathers its light.
struct SceneTime {
  bool own_lamp = true;                  // false: every figure is the manufacturer's
  bool daylight = false;                 // neither pulses nor follows the mains
  std::optional<double> flicker_hz;      // twice the mains frequency, or the dimmer's
  std::optional<double> duty;            // lit part of a period: pulse width modulation
  std::optional<double> ripple;          // (max - min)/(max + min) of a smooth ripple
  std::optional<double> window_s;        // of one reading
  std::optional<double> on_for_s;        // since the lamp was switched on
  std::optional<bool> filament;          // follows the mains voltage
  std::optional<double> haze_per_metre;  // extinction of the air
};

// Readings that come out of pictures.
struct ScenePicture {
  std::optional<double> exposure_s;
  std::optional<double> rows_s;  // from the first to the last row averaged; 0 = global shutter
  bool flat_field = false;       // divided by the lens's own map
  std::optional<double> glare;   // of the lens: part of the picture's mean on every pixel
  std::optional<double> mean_over_patch;  // the picture's mean luminance over the patch's
  std::optional<double> off_middle_rad;   // of what was read, from the lens's axis
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
  bool no_walls = false;              // draped in black, or outdoors behind cards
  bool over_ground = false;           // outdoors: of all walls the ground alone
  bool dark = false;                  // draped in black, and nothing else shines
  std::vector<WallHypothesis> walls;  // what a fit knows of their light; empty: no fit asks
  std::vector<LampMake> makes;        // what the lamp may be, where no wall shines
  std::vector<OffsetPart> offsets;    // where such a lamp's light starts; empty: 15 % of d
  std::optional<double> spectral_f1;  // of the worst meter that states it, fraction
  std::optional<double> cosine_f2;
  std::optional<Metres> head_radius;
  SceneTime time;
  std::optional<ScenePicture> picture;
  std::optional<double> table_step_rad;  // of a table of directions: the largest along a plane
  // What each distance may be off by, 95 %: the readings' sigmas hold it. Absent: they do not.
  std::optional<double> distance_error_m;
};

[[nodiscard]] double NearestDistance(const Scene& scene);
[[nodiscard]] double FarthestDistance(const Scene& scene);
[[nodiscard]] double LargestTilt(const Scene& scene);
[[nodiscard]] double LargestEmission(const Scene& scene);
// Whether the light follows a distance at all.
[[nodiscard]] bool FollowsDistance(const Scene& scene);
// The radius around the axis that the source fills: half its largest side; absent when unknown.
[[nodiscard]] std::optional<double> SourceRadius(const Scene& scene);

}  // namespace lightcal
