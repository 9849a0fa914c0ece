// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/room_bounce.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lightcal/light/beam_ensemble.h"
#include "lightcal/photometry/spot_cone.h"

namespace lightcal {
namespace {

constexpr double kInside = 0.05;  // metres between a point and the wall it was moved from

// Relative intensity over directions.
class Pattern {
 public:
  explicit Pattern(const Scene& scene) : aim_(scene.aim) {
    const bool flat = scene.kind == LightKind::kDisk || scene.kind == LightKind::kRect;
    if (scene.outer && !flat) {
      cone_ = SpotCone{scene.inner.value_or(Radians(0.0)), *scene.outer};
    } else if (scene.beam && scene.beam->value() > 0.0 && *scene.beam < kWidestBeam) {
      exponent_ = std::log(0.5) / std::log(std::cos(0.5 * scene.beam->value()));
    } else if (flat) {
      exponent_ = 1.0;
    }
    even_ = !cone_ && exponent_ == 0.0;
  }

  [[nodiscard]] bool even() const { return even_; }

  void AimAt(const Vec3& direction) {
    if (!aim_) aim_ = direction;
  }

  [[nodiscard]] double Toward(const Vec3& direction) const {
    if (even_ || !aim_) return 1.0;
    if (cone_) {
      return SpotAttenuation(AngleFromAim(*aim_, direction), *cone_, SpotFalloff::kSquaredLinear);
    }
    const double cosine = Dot(*aim_, direction) / (Length(*aim_) * Length(direction));
    return cosine > 0.0 ? std::pow(cosine, exponent_) : 0.0;
  }

  // Flux per candela on the axis.
  [[nodiscard]] double SolidAngle() const {
    if (even_) return 4.0 * std::numbers::pi;
    if (cone_) return SolidAngleOfSpot(*cone_, SpotFalloff::kSquaredLinear).value();
    return 2.0 * std::numbers::pi / (exponent_ + 1.0);
  }

 private:
  std::optional<Vec3> aim_;
  std::optional<SpotCone> cone_;
  double exponent_ = 0.0;
  bool even_ = true;
};

Vec3 MovedInside(Vec3 p, const Vec3& size) {
  for (int axis = 0; axis < 3; ++axis) {
    const double low = LowEnd(size, axis);
    const double margin = std::min(kInside, 0.25 * size[axis]);
    p[axis] = std::clamp(p[axis], low + margin, low + size[axis] - margin);
  }
  return p;
}

// Edges of patches along one side, graded about `foot` with the lamp's height over the wall.
std::vector<double> Grade(int patches, double low, double high, double foot, double height) {
  std::vector<double> edges(static_cast<std::size_t>(patches) + 1);
  const double from = std::asinh((low - foot) / height);
  const double to = std::asinh((high - foot) / height);
  for (int i = 0; i <= patches; ++i) {
    edges[static_cast<std::size_t>(i)] =
        foot + height * std::sinh(from + (to - from) * i / patches);
  }
  return edges;
}

struct FacingMeter {
  Vec3 position;
  Vec3 normal;
};

// One wall: coordinate `axis` fixed at `at`, normal `inward` along it.
class Wall {
 public:
  Wall(const Pattern& pattern, const Vec3& lamp, const FacingMeter& receiver, int axis, double at,
       double inward)
      : pattern_(pattern),
        lamp_(lamp),
        receiver_(receiver),
        axis_(axis),
        at_(at),
        inward_(inward) {}

  [[nodiscard]] int u() const { return (axis_ + 1) % 3; }
  [[nodiscard]] int v() const { return (axis_ + 2) % 3; }
  [[nodiscard]] double height() const { return std::abs(lamp_[axis_] - at_); }

  // What a patch u0..u1, v0..v1 throws back, by its middle. One that is wide for the meter's
  // distance is halved each way, `splits` times at most.
  [[nodiscard]] double FromPatch(double u0, double u1, double v0, double v1, int splits = 3) const {
    constexpr double kWide = 0.7;  // side over distance
    const double um = 0.5 * (u0 + u1), vm = 0.5 * (v0 + v1);
    Vec3 patch{};
    patch[axis_] = at_;
    patch[u()] = um;
    patch[v()] = vm;
    const Vec3 to_patch = patch - receiver_.position;
    const double distance = Length(to_patch);
    if (splits > 0 && std::max(u1 - u0, v1 - v0) > kWide * distance) {
      return FromPatch(u0, um, v0, vm, splits - 1) + FromPatch(um, u1, v0, vm, splits - 1) +
             FromPatch(u0, um, vm, v1, splits - 1) + FromPatch(um, u1, vm, v1, splits - 1);
    }
    const double at_receiver = Dot(receiver_.normal, to_patch) / distance;
    const double at_wall = -inward_ * to_patch[axis_] / distance;
    if (at_receiver <= 0.0 || at_wall <= 0.0) return 0.0;
    const Vec3 from_lamp = patch - lamp_;
    const double lamp_distance = Length(from_lamp);
    const double wall_illuminance =
        pattern_.Toward(from_lamp) * height() / (lamp_distance * lamp_distance * lamp_distance);
    // A patch as large as its distance acts as a disk: pi r^2 + A instead of pi r^2.
    const double area = (u1 - u0) * (v1 - v0);
    return wall_illuminance * area * at_receiver * at_wall /
           (std::numbers::pi * distance * distance + area);
  }

 private:
  const Pattern& pattern_;
  const Vec3& lamp_;
  const FacingMeter& receiver_;
  int axis_;
  double at_, inward_;
};

double FromWall(const RoomBox& room, const Vec3& lamp, const Wall& wall) {
  const auto patches = static_cast<std::size_t>(room.bounce_patches);
  const auto edges = [&](int side) {
    const double low = LowEnd(room.size_m, side);
    return Grade(room.bounce_patches, low, low + room.size_m[side], lamp[side], wall.height());
  };
  const auto u = edges(wall.u());
  const auto v = edges(wall.v());
  double sum = 0.0;
  for (std::size_t i = 0; i < patches; ++i) {
    for (std::size_t j = 0; j < patches; ++j) {
      sum += wall.FromPatch(u[i], u[i + 1], v[j], v[j + 1]);
    }
  }
  return room.reflectance * sum;
}

}  // namespace

Bounce BounceAt(const Scene& scene, const ScenePose& pose) {
  const Vec3& size = scene.room->size_m;
  const Vec3 lamp = MovedInside(scene.position_m.value_or(Vec3{0.0, 0.0, 0.5 * size[2]}), size);
  const Vec3 along = scene.aim.value_or(size[0] >= size[1] ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  const Vec3 stated = pose.position_m.value_or(lamp + along * (pose.distance_m / Length(along)));
  const Vec3 position = MovedInside(stated, size);
  const Vec3 to_lamp = lamp - position;
  const double distance = Length(to_lamp);
  const FacingMeter receiver{position, distance > 0.0 ? to_lamp * (1.0 / distance) : along * -1.0};

  Pattern pattern(scene);
  pattern.AimAt(receiver.normal * -1.0);
  Bounce out;
  out.even = pattern.even();
  out.toward = pattern.Toward(receiver.normal * -1.0);
  for (int axis = 0; axis < 3; ++axis) {
    const double low = axis == 2 ? 0.0 : -0.5 * size[axis];
    out.first += FromWall(*scene.room, lamp, Wall(pattern, lamp, receiver, axis, low, 1.0));
    out.first +=
        FromWall(*scene.room, lamp, Wall(pattern, lamp, receiver, axis, low + size[axis], -1.0));
  }
  const double rho = scene.room->reflectance;
  out.tail = rho * rho * pattern.SolidAngle() / (AreaOfWalls_m2(size) * (1.0 - rho));
  return out;
}

}  // namespace lightcal
