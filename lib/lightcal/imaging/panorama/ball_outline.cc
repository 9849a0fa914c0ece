// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/ball_outline.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lightcal {
namespace {

constexpr int kOutlinePoints = 360;
constexpr int kConeRounds = 30;
constexpr double kBoxTolerance = 0.02;  // of the box's side: what a sphere may miss it by

// Left, top, right, bottom of a cone's outline in the picture.
std::optional<Eigen::Vector4d> BoxOf(const PixelSolidAngles& view, const Vec3& axis, double angle) {
  const Vec3 any = std::abs(axis[2]) < 0.9 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
  const Vec3 cross = Cross(axis, any);
  const Vec3 u = cross * (1.0 / Length(cross)), v = Cross(axis, u);
  constexpr double kFar = std::numeric_limits<double>::max();
  Eigen::Vector4d box(kFar, kFar, -kFar, -kFar);
  for (int i = 0; i < kOutlinePoints; ++i) {
    const double t = 2.0 * std::numbers::pi * i / kOutlinePoints;
    const auto point = view.PointOf(axis * std::cos(angle) +
                                    (u * std::cos(t) + v * std::sin(t)) * std::sin(angle));
    if (!point) return std::nullopt;
    box[0] = std::min(box[0], (*point)[0]);
    box[1] = std::min(box[1], (*point)[1]);
    box[2] = std::max(box[2], (*point)[0]);
    box[3] = std::max(box[3], (*point)[1]);
  }
  return box;
}

}  // namespace

// By Gauss and Newton over two angles and a radius.
std::optional<BallCone> ConeOfBall(const PixelSolidAngles& view,
                                   const std::array<double, 4>& outline) {
  const auto& [x, y, w, h] = outline;
  const auto middle = view.Direction(x + w / 2.0, y + h / 2.0);
  const auto edge = view.Direction(x + w, y + h / 2.0);
  if (!middle || !edge) return std::nullopt;
  const Eigen::Vector4d wanted(x, y, x + w, y + h);
  const Vec3 cross = Cross(*middle, Vec3{0.0, 0.0, 1.0});
  if (Length(cross) < 1e-6) return std::nullopt;
  const Vec3 right = cross * (1.0 / Length(cross)), up = Cross(right, *middle);
  const auto cone = [&](const Eigen::Vector3d& p) {
    const Vec3 axis = *middle + right * p[0] + up * p[1];
    return BallCone{axis * (1.0 / Length(axis)), p[2]};
  };
  const auto box = [&](const Eigen::Vector3d& p) {
    const BallCone c = cone(p);
    return BoxOf(view, c.axis, c.angle);
  };
  Eigen::Vector3d p(0.0, 0.0, std::acos(std::min(1.0, Dot(*middle, *edge))));
  for (int round = 0; round < kConeRounds; ++round) {
    const auto now = box(p);
    if (!now) return std::nullopt;
    Eigen::Matrix<double, 4, 3> slope;
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d moved = p;
      moved[k] += 1e-5;
      const auto there = box(moved);
      if (!there) return std::nullopt;
      slope.col(k) = (*there - *now) / 1e-5;
    }
    const Eigen::Vector3d step = slope.colPivHouseholderQr().solve(wanted - *now);
    p += step;
    if (step.norm() < 1e-12) break;
  }
  const auto reached = box(p);
  if (!reached || !(p[2] > 0.0)) return std::nullopt;
  const double miss = (wanted - *reached).cwiseAbs().maxCoeff();
  if (miss > std::max(1.0, kBoxTolerance * std::max(w, h))) return std::nullopt;
  return cone(p);
}

}  // namespace lightcal
