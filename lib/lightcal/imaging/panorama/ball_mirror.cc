// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/ball_mirror.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lightcal/imaging/panorama/ball_outline.h"

namespace lightcal {
namespace {

constexpr double kChromiumN = 3.1;
constexpr double kPerfectMirror = 0.9995;
constexpr double kFarRadii = 1e4;  // a camera without a distance stands here
constexpr double kOutlinePixels = 2.0;
constexpr double kLeastRadiusPixels = 8.0;
constexpr double kMostOblong = 1.1;  // sides of a ball's box, cut out of an ordinary lens's picture
constexpr int kNewtonRounds = 20;

tl::unexpected<Error> BadBall(const std::string& name, const char* message) {
  return Refused("bad_ball", name, message);
}

}  // namespace

double MirrorReflectance(double normal_reflectance, Radians incidence) {
  const double r0 = normal_reflectance;
  if (r0 >= kPerfectMirror) return r0;
  double n = kChromiumN;
  double k2 = (r0 * (n + 1.0) * (n + 1.0) - (n - 1.0) * (n - 1.0)) / (1.0 - r0);
  if (k2 < 0.0) {
    n = (1.0 + std::sqrt(r0)) / (1.0 - std::sqrt(r0));
    k2 = 0.0;
  }
  const double c = std::cos(std::min(incidence.value(), std::numbers::pi / 2.0));
  const double c2 = c * c, s2 = 1.0 - c2;
  const double t = n * n - k2 - s2;
  const double both = std::sqrt(t * t + 4.0 * n * n * k2);
  const double a = std::sqrt(std::max(0.0, (both + t) / 2.0));
  const double s_part = (both + c2 - 2.0 * a * c) / (both + c2 + 2.0 * a * c);
  const double across = c2 * both + s2 * s2, along = 2.0 * a * c * s2;
  return s_part * (1.0 + (across - along) / (across + along)) / 2.0;
}

Result<BallMirror> BallMirror::Create(const std::string& name, int width, int height,
                                      const BallView& ball) {
  const auto& [x, y, w, h] = ball.outline;
  const bool inside = x >= 0.0 && y >= 0.0 && x + w <= width && y + h <= height;
  if (!inside || std::min(w, h) < 2.0 * kLeastRadiusPixels) {
    return BadBall(name,
                   "the ball's box, x,y,width,height in pixels, lies in the picture and is at "
                   "least 16 pixels wide; it touches the ball's outline on all four sides");
  }
  if (ball.field_of_view) {
    auto lens =
        PixelSolidAngles::Create({Projection::kRectilinear, width, height, *ball.field_of_view});
    if (!lens) return Propagate(std::move(lens));
    const auto cone = ConeOfBall(*lens, ball.outline);
    if (!cone) {
      return BadBall(name,
                     "no sphere fills this box; x,y,width,height touches the ball's outline on all "
                     "four sides, and {view.field_of_view} is the lens's across the whole width");
    }
    return BallMirror(std::move(*lens), ball, cone->axis, cone->angle, false);
  }
  if (std::max(w, h) > kMostOblong * std::min(w, h)) {
    return BadBall(name,
                   "its box is oblong: it touches the ball's outline on all four sides; a wide "
                   "lens draws a ball oblong towards its corners, then give {view.field_of_view}");
  }
  const double radii = 2.0 * ball.distance_diameters.value_or(kFarRadii / 2.0);
  if (!(radii > 1.0)) {
    return BadBall(name,
                   "the camera stands outside the ball: its distance to the ball's middle is "
                   "more than half a diameter");
  }
  const double angle = std::asin(1.0 / radii);
  const double focal = (w + h) / 4.0 / std::tan(angle);
  auto lens = PixelSolidAngles::Create(
      {Projection::kRectilinear, width, height, Radians(2.0 * std::atan(width / 2.0 / focal))});
  if (!lens) return Propagate(std::move(lens));
  return BallMirror(std::move(*lens), ball, Vec3{0.0, 1.0, 0.0}, angle, true);
}

BallMirror::BallMirror(PixelSolidAngles lens, const BallView& ball, const Vec3& axis, double angle,
                       bool looks_at_ball)
    : lens_(std::move(lens)),
      ball_(ball),
      axis_(axis),
      angle_(angle),
      distance_(1.0 / std::sin(angle)),
      looks_at_ball_(looks_at_ball) {
  const double radius_px = std::min(ball.outline[2], ball.outline[3]) / 2.0;
  rim_share_ = 1.0 - kOutlinePixels / radius_px;
  // sin theta = share / D is seen at phi + theta = asin(share).
  const double theta = std::asin(rim_share_ / distance_);
  blind_ = Radians(std::numbers::pi - LightAngle(std::asin(rim_share_) - theta));
}

double BallMirror::LightAngle(double phi) const {
  return 2.0 * phi + std::atan2(std::sin(phi), distance_ - std::cos(phi));
}

Radians BallMirror::Pitch() const {
  // d beta / d(R sin theta / sin angle) in the middle: phi = (D - 1) theta there.
  const double radius_px = (ball_.outline[2] + ball_.outline[3]) / 4.0;
  return Radians((2.0 * (distance_ - 1.0) + 1.0) / distance_ / radius_px);
}

std::optional<BallMirror::Surface> BallMirror::SurfaceAt(double x, double y) const {
  Vec3 sight;
  if (looks_at_ball_) {
    const auto& [left, top, w, h] = ball_.outline;
    const double steep = std::tan(angle_);
    const Vec3 v{steep * (2.0 * (x - left) / w - 1.0), 1.0, steep * (1.0 - 2.0 * (y - top) / h)};
    sight = v * (1.0 / Length(v));
  } else {
    const auto v = lens_.Direction(x, y);
    if (!v) return std::nullopt;
    sight = *v;
  }
  const double along = distance_ * Dot(sight, axis_);
  const double aside = Length(sight * along - axis_ * distance_);
  if (along <= 0.0 || aside >= 1.0) return std::nullopt;
  const Vec3 hit = sight * (along - std::sqrt(1.0 - aside * aside));
  return Surface{hit - axis_ * distance_, aside};
}

std::optional<BallMirror::Seen> BallMirror::See(const Vec3& direction) const {
  const double along = Dot(direction, axis_);
  const Vec3 lateral = direction - axis_ * along;
  const double aside = Length(lateral);
  const double beta = std::atan2(aside, -along);
  if (beta > std::numbers::pi - blind_.value()) return std::nullopt;
  double phi = beta / 2.0;
  for (int round = 0; round < kNewtonRounds; ++round) {
    const double c = std::cos(phi);
    const double slope =
        2.0 + (distance_ * c - 1.0) / (distance_ * distance_ - 2.0 * distance_ * c + 1.0);
    const double step = (LightAngle(phi) - beta) / slope;
    phi -= step;
    if (std::abs(step) < 1e-12) break;
  }
  const double theta = std::atan2(std::sin(phi), distance_ - std::cos(phi));
  const Vec3 away = aside > 1e-12 ? lateral * (1.0 / aside) : Vec3{};
  Seen seen;
  seen.rim_share = std::sin(theta) * distance_;
  seen.reflectance = MirrorReflectance(ball_.reflectance, Radians(phi + theta));
  if (!looks_at_ball_) {
    const auto point = lens_.PointOf(axis_ * std::cos(theta) + away * std::sin(theta));
    if (!point) return std::nullopt;
    seen.point = *point;
    return seen;
  }
  const auto& [x, y, w, h] = ball_.outline;
  const double share = std::tan(theta) / std::tan(angle_);
  seen.point = {x + w / 2.0 * (1.0 + share * away[0]), y + h / 2.0 * (1.0 - share * away[2])};
  return seen;
}

}  // namespace lightcal
