// SPDX-License-Identifier: Apache-2.0
#include "room.h"

#include <algorithm>
#include <limits>

namespace traced_rooms {
namespace {

constexpr double kAtOnce = 1e-9;  // m: a ray does not meet the surface it leaves

struct Entry {
  double distance = std::numeric_limits<double>::infinity();
  int axis = 0;
};

// Where a ray enters a box from outside.
Entry EntryOf(const Box& box, const Vec3& origin, const Vec3& inverse) {
  double in = -std::numeric_limits<double>::infinity();
  double out = std::numeric_limits<double>::infinity();
  Entry entry;
  for (int i = 0; i < 3; ++i) {
    double near = (box.low[i] - origin[i]) * inverse[i];
    double far = (box.high[i] - origin[i]) * inverse[i];
    if (near > far) std::swap(near, far);
    if (near > in) {
      in = near;
      entry.axis = i;
    }
    out = std::min(out, far);
  }
  if (in < out && in > kAtOnce) entry.distance = in;
  return entry;
}

Vec3 InverseOf(const Vec3& direction) {
  Vec3 inverse;
  for (int i = 0; i < 3; ++i) {
    inverse[i] = 1.0 / (std::abs(direction[i]) < 1e-15 ? 1e-15 : direction[i]);
  }
  return inverse;
}

}  // namespace

double Room::Area() const {
  return 2.0 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
}

double Room::MeanAlbedo() const {
  double sum = 0.0;
  for (int wall = 0; wall < 6; ++wall) {
    const int axis = wall / 2;
    const int b = (axis + 1) % 3;
    const int c = (axis + 2) % 3;
    sum += albedo[wall] * size[b] * size[c];
    if (window && window->wall == wall) {
      sum += (window->albedo - albedo[wall]) * (window->high[b] - window->low[b]) *
             (window->high[c] - window->low[c]);
    }
  }
  return sum / Area();
}

Hit Room::Trace(const Vec3& origin, const Vec3& direction) const {
  const Vec3 inverse = InverseOf(direction);
  double distance = std::numeric_limits<double>::infinity();
  int wall = 0;
  for (int i = 0; i < 3; ++i) {
    const bool up = inverse[i] > 0.0;
    const double to_wall = ((up ? size[i] : 0.0) - origin[i]) * inverse[i];
    if (to_wall < distance) {
      distance = to_wall;
      wall = 2 * i + (up ? 1 : 0);
    }
  }
  const Box* met = nullptr;
  int axis = wall / 2;
  for (const Box& box : boxes) {
    const Entry entry = EntryOf(box, origin, inverse);
    if (entry.distance < distance) {
      distance = entry.distance;
      axis = entry.axis;
      met = &box;
    }
  }
  Hit hit;
  hit.point = origin + std::max(0.0, distance) * direction;
  hit.normal = {0, 0, 0};
  hit.normal[axis] = inverse[axis] > 0.0 ? -1.0 : 1.0;
  if (met != nullptr) {
    hit.albedo = met->albedo;
    hit.point[axis] = inverse[axis] > 0.0 ? met->low[axis] : met->high[axis];
    return hit;
  }
  hit.point[axis] = inverse[axis] > 0.0 ? size[axis] : 0.0;
  hit.albedo = albedo[wall];
  hit.glossy = wall == glossy_wall;
  if (window && window->wall == wall) {
    const int b = (axis + 1) % 3;
    const int c = (axis + 2) % 3;
    if (hit.point[b] > window->low[b] && hit.point[b] < window->high[b] &&
        hit.point[c] > window->low[c] && hit.point[c] < window->high[c]) {
      hit.albedo = window->albedo;
    }
  }
  return hit;
}

bool Room::Blocked(const Vec3& from, const Vec3& to) const {
  const Vec3 way = to - from;
  const Vec3 inverse = InverseOf(way);  // distances are shares of the way
  return std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
    return EntryOf(box, from, inverse).distance < 1.0 - kAtOnce;
  });
}

double Room::CoatReflectance(double cosine) const {
  return glossy_f0 + (1.0 - glossy_f0) * std::pow(1.0 - cosine, 5.0);
}

Vec3 Room::Mirrored(const Vec3& point, bool place) const {
  const int axis = glossy_wall / 2;
  const double plane = place && glossy_wall % 2 == 1 ? size[axis] : 0.0;
  Vec3 image = point;
  image[axis] = 2.0 * plane - point[axis];
  return image;
}

}  // namespace traced_rooms
