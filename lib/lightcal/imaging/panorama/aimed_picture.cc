// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/aimed_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lightcal {
namespace {

constexpr double kRimPixels = 2.0;  // whose neighbours the rim cuts
// Camera, stand and person, as the ball shows them: radians around the way back to the camera.
constexpr double kCameraHidden = 0.35, kCameraFades = 0.17;

}  // namespace

double ViewLens::ShownAt(double ideal) const {
  constexpr int kNewtonSteps = 8;
  double s = ideal;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double s2 = s * s;
    const double slope = 1.0 - a - b + s2 * (3.0 * a + 5.0 * b * s2);
    const double step = (s * Stretch(s2, a, b) - ideal) / slope;
    s -= step;
    if (std::abs(step) < 1e-10) break;
  }
  return s;
}

AimedView::AimedView(PixelSolidAngles angles, const ViewAim& aim, const ViewLens& lens)
    : angles_(std::move(angles)), lens_(lens), rim_share_(1.0) {
  const double yaw = aim.yaw.value(), pitch = aim.pitch.value();
  forward_ = {std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch), std::sin(pitch)};
  const Vec3 level = {std::cos(yaw), -std::sin(yaw), 0.0};
  const Vec3 upright = Cross(level, forward_);
  const double c = std::cos(aim.roll.value()), s = std::sin(aim.roll.value());
  right_ = level * c - upright * s;
  up_ = upright * c + level * s;
  const PictureView& view = angles_.view();
  if (view.projection == Projection::kEquidistant || view.projection == Projection::kEquisolid) {
    rim_share_ = 1.0 - 2.0 * kRimPixels / std::min(view.width, view.height);
  }
}

AimedView::AimedView(BallMirror ball, const ViewAim& aim) : AimedView(ball.lens(), aim) {
  ball_ = std::move(ball);
}

std::optional<AimedView::Sight> AimedView::See(const Vec3& direction) const {
  const Vec3 own{Dot(right_, direction), Dot(forward_, direction), Dot(up_, direction)};
  if (ball_) {
    const auto seen = ball_->See(own);
    if (!seen) return std::nullopt;
    const double from_camera = std::acos(std::clamp(-Dot(own, ball_->axis()), -1.0, 1.0));
    const double t = std::clamp((from_camera - kCameraHidden) / kCameraFades, 0.0, 1.0);
    return Sight{seen->point, seen->rim_share, seen->reflectance, t * t * (3.0 - 2.0 * t)};
  }
  auto point = angles_.PointOf(own);
  if (!point) return std::nullopt;
  double share = angles_.RimShare((*point)[0], (*point)[1]);
  if (share > 0.0 && (lens_.a != 0.0 || lens_.b != 0.0)) {
    const PictureView& view = angles_.view();
    const double shown = lens_.ShownAt(share);
    for (std::size_t k = 0; k < 2; ++k) {
      const double size = k == 0 ? view.width : view.height;
      (*point)[k] = size / 2.0 + shown / share * ((*point)[k] - size / 2.0);
      if (!((*point)[k] >= 0.0 && (*point)[k] <= size)) return std::nullopt;
    }
    share = shown;
  }
  if (share > rim_share_) return std::nullopt;
  return Sight{*point, share};
}

std::optional<std::array<double, 2>> AimedView::PointOf(const Vec3& direction) const {
  const auto sight = See(direction);
  return sight ? std::optional(sight->point) : std::nullopt;
}

Radians AimedView::Pitch() const { return ball_ ? ball_->Pitch() : angles_.MiddlePitch(); }

PictureTap TapAt(const PictureView& view, const std::array<double, 2>& point) {
  const double x = point[0] - 0.5, y = point[1] - 0.5;
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  const auto fx = static_cast<float>(x - left), fy = static_cast<float>(y - top);
  const auto column = [&](int c) {
    if (view.projection == Projection::kLatLong) return (c + view.width) % view.width;
    return std::clamp(c, 0, view.width - 1);
  };
  PictureTap tap;
  for (int i = 0; i < 4; ++i) {
    const int dx = i % 2, dy = i / 2;
    const int row = std::clamp(top + dy, 0, view.height - 1);
    const auto at = static_cast<std::size_t>(i);
    tap.pixel[at] = static_cast<std::size_t>(row) * static_cast<std::size_t>(view.width) +
                    static_cast<std::size_t>(column(left + dx));
    tap.weight[at] = (dx == 1 ? fx : 1.0F - fx) * (dy == 1 ? fy : 1.0F - fy);
  }
  return tap;
}

bool AnyClipped(const AimedPicture& picture, const PictureTap& tap) {
  if (picture.clipped.empty()) return false;
  return std::ranges::any_of(tap.pixel, [&](std::size_t i) { return picture.clipped[i] != 0; });
}

}  // namespace lightcal
