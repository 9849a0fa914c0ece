// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/predicted_lamp.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/light/effects/finite_source.h"
#include "lightcal/light/effects/narrow_beam.h"
#include "lightcal/light/lamp_over_plane.h"

namespace lightcal {
namespace {

// Standard deviation of a rectangular distribution of that half width.
double Rectangular(double half_width) { return half_width / std::sqrt(3.0); }

double Ratio(double bound, double direct) {
  constexpr double kNoDirectLight = 1e9;
  if (!(bound > 0.0)) return 0.0;
  return direct > 0.0 ? bound / direct : kNoDirectLight;
}

}  // namespace

SourceDetail DetailOf(EffectChoice finite_source, double tolerance) {
  if (finite_source == EffectChoice::kNever) return {true, 0.0};
  return {false, finite_source == EffectChoice::kAlways ? 0.0 : tolerance};
}

PredictedLamp::PredictedLamp(const PlacedLamp& lamp, const MapSettings& settings,
                             std::shared_ptr<SharedExchange> shared)
    : lamp_(Settled(lamp)),
      haze_per_m_(settings.haze_per_m),
      room_(settings.room),
      shared_(std::move(shared)) {
  const LampDoubt& doubt = lamp.doubt;
  shape_unsure_ = doubt.place.has_value() || doubt.aim_rad > 0.0 || doubt.inner_rad > 0.0 ||
                  doubt.outer_rad > 0.0 || doubt.pattern != nullptr;
  const bool walls = room_ && room_->reflectance > 0.0 &&
                     settings.room_bounce != EffectChoice::kNever && !IsEverywhere(lamp.source);
  if (!walls) return;
  coarse_.emplace(WallLight::Coarse(*room_, lamp_));
  FindHotSpots();
}

void PredictedLamp::FindHotSpots() {
  constexpr double kLeastSize = 0.05;
  constexpr double kBeamShare = 0.2;  // of the way to the wall
  const Vec3& from = lamp_.pose.position_m;
  const Vec3& aim = lamp_.pose.frame.z;
  double to_wall = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = LowEnd(room_->size_m, axis);
    for (const double wall : {low, low + room_->size_m[axis]}) {
      HotSpot foot{from, std::max(kLeastSize, std::abs(wall - from[axis]))};
      foot.position_m[axis] = wall;
      hot_spots_.push_back(foot);
      if (aim[axis] == 0.0) continue;  // along the wall
      const double along = (wall - from[axis]) / aim[axis];
      if (along > 0.0) to_wall = std::min(to_wall, along);
    }
  }
  const bool beam = std::holds_alternative<SpotSource>(lamp_.source) ||
                    std::holds_alternative<TableSource>(lamp_.source);
  if (beam && to_wall < 1e300) {
    hot_spots_.push_back({from + aim * to_wall, std::max(kLeastSize, kBeamShare * to_wall)});
  }
}

const WallLight& PredictedLamp::Walls() const {
  std::call_once(fine_->once, [this] {
    fine_->walls.emplace(WallLight::Fine(*room_, lamp_, shared_->Of(*room_)));
  });
  return *fine_->walls;
}

double PredictedLamp::WallsU95Relative() const {
  return std::hypot(Walls().u95_relative(), kZ95 * DoubtOfLnFlux(lamp_));
}

double PredictedLamp::BounceOverDirect(std::span<const SurfacePoint> points) const {
  double worst = 0.0;
  for (const SurfacePoint& at : points) {
    worst = std::max(worst, Ratio(coarse_->BoundAt(at), LuxOf(lamp_, at, {false, 0.1})));
  }
  return worst;
}

double PredictedLamp::BounceBound(std::span<const SurfacePoint> points) const {
  double most = 0.0;
  for (const SurfacePoint& at : points) most = std::max(most, coarse_->BoundAt(at));
  return most;
}

double PredictedLamp::OverDirect(double lux, std::span<const SurfacePoint> points) const {
  double worst = 0.0;
  for (const SurfacePoint& at : points) {
    worst = std::max(worst, Ratio(lux, LuxOf(lamp_, at, {false, 0.1})));
  }
  return worst;
}

// Relative standard deviation of what no parameter holds: clear air, the size of a lamp that states
// none.
double PredictedLamp::Unmodelled(const SurfacePoint& at) const {
  if (IsEverywhere(lamp_.source)) return 0.0;
  const double d = Length(at.position_m - lamp_.pose.position_m);
  if (!(d > 0.0)) return 0.0;
  const double ratio = effects::kRadiusDefault / d;
  double size = 0.0;
  if (const auto* spot = std::get_if<SpotSource>(&lamp_.source)) {
    const double half = 0.5 * (spot->cone.inner.value() + spot->cone.outer.value());
    const bool narrow = half < RadiansFromDegrees(80.0).value();
    size = ratio * ratio * (narrow ? 0.25 * (effects::BeamExponent(half) + 3.0) : 1.0);
  } else if (std::holds_alternative<PointSource>(lamp_.source) ||
             std::holds_alternative<TableSource>(lamp_.source)) {
    size = ratio * ratio;
  }
  return std::hypot(Rectangular(haze_per_m_ * d), Rectangular(std::min(1.0, size)));
}

double PredictedLamp::DirectU95(const SurfacePoint& at, double direct_lx,
                                const SourceDetail& detail, double left_off) const {
  const double rest = std::hypot(Rectangular(left_off), Unmodelled(at));
  return kZ95 * std::hypot(DoubtOfLux(lamp_, at, detail), direct_lx * rest);
}

}  // namespace lightcal
