// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/mirror_ball.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/panorama/ball_outline.h"

namespace lightcal {
namespace {

constexpr int kRounds = 30;
constexpr double kDistanceSd = 0.01;  // of a tape measure, m
constexpr double kMostMiss = 4.0, kMostDepthSd = 0.5;

struct Axes {
  Vec3 right, forward, up;
};

Axes AxesOf(const CameraPose& camera) {
  const Vec3 forward = camera.aim * (1.0 / Length(camera.aim));
  Vec3 level = Cross(forward, Vec3{0.0, 0.0, 1.0});
  const double tilt = Length(level);
  level = tilt > 1e-9 ? level * (1.0 / tilt) : Vec3{1.0, 0.0, 0.0};
  const Vec3 upright = Cross(level, forward);
  const double c = std::cos(camera.roll.value()), s = std::sin(camera.roll.value());
  return {level * c - upright * s, forward, upright * c + level * s};
}

Vec3 InRoom(const Axes& axes, const Vec3& v) {
  return axes.right * v[0] + axes.forward * v[1] + axes.up * v[2];
}

struct Reflection {
  Vec3 ball, from, direction;
};

Result<Reflection> Reflect(const BallPicture& picture) {
  const auto cone = ConeOfBall(picture.view, picture.outline);
  if (!cone) {
    return Refused(
        "bad_ball", picture.name,
        "no sphere fills this box; rect = [x, y, width, height] touches the ball's "
        "outline on all four sides, wholly inside the picture, and fov_deg is the lens's");
  }
  const auto sight = picture.view.Direction(picture.highlight[0], picture.highlight[1]);
  const double radius = picture.diameter.value() / 2.0;
  const Axes axes = AxesOf(picture.camera);
  const Vec3 away = InRoom(axes, cone->axis) * (radius / std::sin(cone->angle));
  const Vec3 look = sight ? InRoom(axes, *sight) : Vec3{};
  const double along = Dot(look, away);
  const double under = along * along - Dot(away, away) + radius * radius;
  if (!sight || under <= 0.0 || along <= 0.0) {
    return Refused("highlight_off_ball", picture.name,
                   "the brightest point in the box is not on the ball; mask it, or correct rect");
  }
  const Vec3 hit = look * (along - std::sqrt(under));
  const Vec3 normal = (hit - away) * (1.0 / radius);
  const Vec3 back = look * -1.0;
  const Vec3 light = normal * (2.0 * Dot(normal, back)) - back;
  const Vec3& camera = picture.camera.position_m;
  return Reflection{camera + away, camera + hit, light};
}

// Every input moved by its sigma.
std::vector<BallPicture> Moved(const BallPicture& picture, const BallErrors& errors) {
  std::vector<BallPicture> all;
  for (std::size_t i = 0; i < 3; ++i) {
    // Left-right, up-down, larger: what a hand-drawn box is off by.
    BallPicture moved = picture;
    if (i < 2) moved.outline[i] += errors.outline_px / std::numbers::sqrt2;
    if (i == 2) {
      for (const std::size_t k : {0, 1}) moved.outline[k] -= errors.outline_px / 2.0;
      for (const std::size_t k : {2, 3}) moved.outline[k] += errors.outline_px;
    }
    all.push_back(moved);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    BallPicture moved = picture;
    moved.highlight[i] += errors.highlight_px;
    all.push_back(moved);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    BallPicture moved = picture;
    moved.camera.position_m[i] += errors.camera_m;
    all.push_back(moved);
  }
  const Axes axes = AxesOf(picture.camera);
  for (const Vec3& side : {axes.right, axes.up}) {
    BallPicture moved = picture;
    moved.camera.aim = axes.forward + side * errors.aim_rad;
    all.push_back(moved);
  }
  BallPicture rolled = picture;
  rolled.camera.roll = picture.camera.roll + Radians(errors.aim_rad);
  all.push_back(rolled);
  return all;
}

Eigen::Vector3d ToEigen(const Vec3& v) { return {v[0], v[1], v[2]}; }

Result<BallLamp> AlongOneRay(const BallRay& ray, Metres distance) {
  // |from + t direction - ball| = distance.
  const Vec3 arm = ray.from_m - ray.ball_m;
  const double along = Dot(arm, ray.direction), d = distance.value();
  const double under = along * along - Dot(arm, arm) + d * d;
  if (under < 0.0 || std::sqrt(under) - along <= 0.0) {
    return Refused("bad_distance", ray.name,
                   "distance_m, from the ball's middle to the lamp, is shorter than the ball");
  }
  const double t = std::sqrt(under) - along;
  BallLamp lamp{ray.from_m + ray.direction * t, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    const double depth = ray.direction[i] * kDistanceSd;
    const double aside = std::sqrt(std::max(0.0, 1.0 - ray.direction[i] * ray.direction[i]));
    lamp.sd_m[i] = std::hypot(depth, aside * std::hypot(ray.angle_sd * t, ray.from_sd_m));
  }
  return lamp;
}

}  // namespace

Result<BallRay> RayOfBall(const BallPicture& picture, const BallErrors& errors) {
  const auto seen = Reflect(picture);
  if (!seen) return tl::unexpected(seen.error());
  BallRay ray{picture.name, seen->ball, seen->from, seen->direction, 0.0, 0.0};
  double angle2 = 0.0, from2 = 0.0;
  for (const BallPicture& moved : Moved(picture, errors)) {
    const auto there = Reflect(moved);
    if (!there) continue;  // a highlight on the very rim
    angle2 += std::pow(Length(there->direction - seen->direction), 2);
    from2 += std::pow(Length(there->from - seen->from), 2);
  }
  // Both are lengths of two-dimensional errors.
  ray.angle_sd = std::sqrt(angle2 / 2.0);
  ray.from_sd_m = std::sqrt(from2 / 2.0);
  return ray;
}

Result<BallLamp> LampOfRays(std::span<const BallRay> rays, std::optional<Metres> distance) {
  if (rays.size() == 1 && distance) return AlongOneRay(rays.front(), *distance);
  if (rays.size() < 2) {
    return Refused("one_ball", rays.empty() ? "" : rays.front().name,
                   "one ball shows a direction only; photograph a second ball (or this one where "
                   "it stands elsewhere), or give distance_m from the ball's middle to the lamp");
  }
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d lamp = Eigen::Vector3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    normal.setZero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const BallRay& ray : rays) {
      const Eigen::Vector3d d = ToEigen(ray.direction), from = ToEigen(ray.from_m);
      const double reach = round == 0 ? 1.0 : (lamp - from).norm();
      const double sd = std::hypot(ray.angle_sd * reach, ray.from_sd_m);
      const Eigen::Matrix3d aside = (Eigen::Matrix3d::Identity() - d * d.transpose()) / (sd * sd);
      normal += aside;
      right += aside * from;
    }
    lamp = normal.ldlt().solve(right);
  }
  const Eigen::Matrix3d covariance = normal.inverse();
  double depth = std::numeric_limits<double>::max();
  for (const BallRay& ray : rays) depth = std::min(depth, (lamp - ToEigen(ray.from_m)).norm());
  const double worst = std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues().maxCoeff());
  if (!(worst < kMostDepthSd * depth) || !lamp.allFinite()) {
    return Refused("rays_parallel", rays.front().name,
                   "the balls show the lamp in nearly one direction, so its distance stays open; "
                   "set them farther apart, across the direction to the lamp");
  }
  for (const BallRay& ray : rays) {
    const Eigen::Vector3d way = lamp - ToEigen(ray.from_m);
    const double along = way.dot(ToEigen(ray.direction));
    const double off = (way - along * ToEigen(ray.direction)).norm();
    const double sd = std::hypot(ray.angle_sd * along, ray.from_sd_m);
    if (along <= 0.0 || off > kMostMiss * sd) {
      return Refused("rays_miss", ray.name,
                     "the balls do not show one lamp: this ray passes " + RoundedText(off, 2) +
                         " m from where the others meet; check the camera's pose and rect, and "
                         "that one lamp is lit");
    }
  }
  BallLamp out{{lamp[0], lamp[1], lamp[2]}, {}};
  for (int i = 0; i < 3; ++i) out.sd_m[static_cast<std::size_t>(i)] = std::sqrt(covariance(i, i));
  return out;
}

}  // namespace lightcal
