// SPDX-License-Identifier: Apache-2.0
// A room that light can be traced in: a box seen from inside, with boxes in it. One wall may be
// glossy.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "vec3.h"

namespace traced_rooms {

struct Box {
  Vec3 low, high;  // m
  double albedo = 0.5;
};

// A rectangle on one wall with an albedo of its own: black glass at night, or a white blind.
struct Window {
  int wall = 0;
  Vec3 low, high;  // as of a box that the wall cuts
  double albedo = 0.05;
};

struct Hit {
  Vec3 point, normal;
  double albedo = 0.0;
  bool glossy = false;
};

struct Room {
  Vec3 size{5, 4, 2.6};  // from (0, 0, 0), m
  // Walls at x = 0, x = size, y = 0, y = size, then floor and ceiling: Lambertian albedo.
  std::array<double, 6> albedo{};
  std::vector<Box> boxes;
  std::optional<Window> window;
  int glossy_wall = -1;     // none
  double glossy_f0 = 0.04;  // reflectance of its coat at normal incidence (Schlick)

  double Area() const;        // of the six, m^2
  double MeanAlbedo() const;  // of the six, by area, the window within

  // The first surface that a ray from inside the room meets.
  Hit Trace(const Vec3& origin, const Vec3& direction) const;
  // Whether furniture stands between two points of the room.
  bool Blocked(const Vec3& from, const Vec3& to) const;

  // The mirror that the glossy wall's coat is (Schlick 1994); 1 at grazing incidence.
  double CoatReflectance(double cosine) const;
  // A point or (with `place` false) a direction mirrored in the glossy wall.
  Vec3 Mirrored(const Vec3& point, bool place) const;
};

}  // namespace traced_rooms
