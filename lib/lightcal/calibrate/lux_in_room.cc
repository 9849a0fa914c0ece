// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/lux_in_room.h"

#include <algorithm>
#include <cmath>

#include "lightcal/fit/fit_light.h"

namespace lightcal {
namespace {

constexpr double kFacing = 0.98;      // cosine from which on a meter faces the lamp
constexpr double kLikeOnAxis = 0.02;  // what a lamp gives there differs from its axis by no more
constexpr double kOtherWalls = 0.4;   // 1 sigma of ln E_walls

// The whole with what a point may shine more or less that way than where it was read.
Uncertain WithPattern(const Uncertain& whole, const FittedLight& light, const PlacedLamp& placed,
                      double direct_lx, const Vec3& way) {
  if (!light.uneven || !placed.doubt.place) return whole;
  const double share = direct_lx / whole.value;
  const UnevenLight uneven = {light.uneven->gradient_sd, placed.doubt.place->middle};
  const double pattern = kZ95 * share * SdTowards(uneven, way * (-1.0 / Length(way)));
  Uncertain out = whole;
  out.low = whole.value * std::exp(-std::hypot(std::log(whole.value / *whole.low), pattern));
  out.high = whole.value * std::exp(std::hypot(std::log(*whole.high / whole.value), pattern));
  out.u95 = std::hypot(whole.u95, pattern * whole.value);
  return out;
}

// Whether the meter faces the lamp where it shines as on its axis, and there as PredictInRoom has
// it, with the intensity of its peak: a photometric lamp's may lie beside its axis.
bool FacesAxis(const FittedLight& light, const PlacedLamp& placed, double direct_lx,
               const SurfacePoint& at, const Vec3& way) {
  const double distance = Length(way);
  if (!(Dot(way, at.normal) > kFacing * distance)) return false;
  if (DoubtOfPattern(placed, at) > kLikeOnAxis * direct_lx) return false;
  if (std::holds_alternative<PointSource>(placed.source) ||
      std::holds_alternative<SphereSource>(placed.source)) {
    return true;
  }
  const Vec3& aim = placed.pose.frame.z;
  const double on_axis = LuxOf(placed, {placed.pose.position_m + aim * distance, aim * -1.0});
  if (light.kind == LightKind::kPhotometric && light.intensity_cd) {
    const double of_peak = light.intensity_cd->value / (distance * distance);
    if (std::abs(on_axis - of_peak) > kLikeOnAxis * of_peak) return false;
  }
  return std::abs(direct_lx - on_axis) < kLikeOnAxis * on_axis;
}

}  // namespace

std::optional<Uncertain> LuxInRoom(const FittedLight& light, const PlacedLamp& placed,
                                   const LampLux& alone, const SurfacePoint& at) {
  if (IsEverywhere(placed.source)) return std::nullopt;
  const Vec3 way = placed.pose.position_m - at.position_m;
  const double distance = Length(way);
  if (!(distance > 0.0)) return std::nullopt;
  if (light.located) {
    if (placed.pose.position_m != light.located->position_m) return std::nullopt;
    return PredictInRoom(light, {at.position_m, at.normal, alone.direct_lx / placed.strength});
  }
  const auto room = PredictInRoom(light, Metres(distance), 0.0);
  if (!room || !*room) return std::nullopt;
  if (FacesAxis(light, placed, alone.direct_lx, at, way)) {
    return WithPattern((*room)->whole_lx, light, placed, alone.direct_lx, way);
  }
  const Uncertain& walls = (*room)->walls_lx;
  const double u95 = std::hypot(alone.u95_lx, walls.u95, kZ95 * kOtherWalls * walls.value);
  const double lux = alone.direct_lx + walls.value;
  return Uncertain{lux, u95, std::max(0.0, lux - u95), lux + u95};
}

}  // namespace lightcal
