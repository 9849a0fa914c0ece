// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/level_aims.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace lightcal {
namespace {

constexpr double kTellsUp = 0.02;  // the middle eigenvalue, of a view: sides in two directions
constexpr double kSteep = 0.8;     // sine of the pitch from which a view has no yaw to give

Eigen::Vector3d ColumnOf(const Vec3& v) { return {v[0], v[1], v[2]}; }

Eigen::Vector3d UpOf(std::span<const CameraAxes> axes) {
  Eigen::Matrix3d sides = Eigen::Matrix3d::Zero();
  Eigen::Vector3d tops = Eigen::Vector3d::Zero();
  for (const CameraAxes& camera : axes) {
    const Eigen::Vector3d right = ColumnOf(camera[0]);
    sides += right * right.transpose() / static_cast<double>(axes.size());
    tops += ColumnOf(camera[2]);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sides);
  Eigen::Vector3d up = solver.eigenvectors().col(0);
  if (up.dot(tops) < 0.0) up = -up;
  if (solver.eigenvalues()[1] > kTellsUp) return up;
  // All right sides are one: up is square to it.
  const Eigen::Vector3d side = solver.eigenvectors().col(2);
  const Eigen::Vector3d square = tops - side * side.dot(tops);
  return square.norm() > 1e-9 ? Eigen::Vector3d(square.normalized()) : up;
}

ViewAim AimOfAxes(const Eigen::Vector3d& right, const Eigen::Vector3d& forward) {
  ViewAim aim;
  const double pitch = std::asin(std::clamp(forward[2], -1.0, 1.0));
  const double yaw = std::atan2(forward[0], forward[1]);
  const Eigen::Vector3d level(std::cos(yaw), -std::sin(yaw), 0.0);
  const Eigen::Vector3d upright = level.cross(forward);
  aim.yaw = Radians(yaw);
  aim.pitch = Radians(pitch);
  aim.roll = Radians(std::atan2(-right.dot(upright), right.dot(level)));
  return aim;
}

}  // namespace

LevelledAims LevelAims(std::span<const CameraAxes> axes, const std::optional<KnownPose>& known) {
  Eigen::Matrix3d turn;  // rows: +X, +Y, +Z of the level place
  if (known) {
    const CameraAxes& camera = axes[known->view];
    const double p = known->pitch.value(), r = known->roll.value();
    const Eigen::Vector3d forward(0.0, std::cos(p), std::sin(p)), level(1.0, 0.0, 0.0);
    const Eigen::Vector3d upright = level.cross(forward);
    const Eigen::Vector3d right = level * std::cos(r) - upright * std::sin(r);
    const Eigen::Vector3d up = upright * std::cos(r) + level * std::sin(r);
    turn = right * ColumnOf(camera[0]).transpose() + forward * ColumnOf(camera[1]).transpose() +
           up * ColumnOf(camera[2]).transpose();
  } else {
    const Eigen::Vector3d up = UpOf(axes);
    const auto gives_yaw = std::ranges::find_if(axes, [&](const CameraAxes& camera) {
      return std::abs(ColumnOf(camera[1]).dot(up)) < kSteep;
    });
    // Of cameras that all look up or down, what is above the first one's picture.
    Eigen::Vector3d front =
        gives_yaw == axes.end() ? ColumnOf(axes.front()[2]) : ColumnOf((*gives_yaw)[1]);
    front = (front - up * up.dot(front)).normalized();
    turn.row(0) = front.cross(up).transpose();
    turn.row(1) = front.transpose();
    turn.row(2) = up.transpose();
  }
  LevelledAims out;
  out.assumed = !known;
  for (const CameraAxes& camera : axes) {
    out.aims.push_back(AimOfAxes(turn * ColumnOf(camera[0]), turn * ColumnOf(camera[1])));
  }
  return out;
}

}  // namespace lightcal
