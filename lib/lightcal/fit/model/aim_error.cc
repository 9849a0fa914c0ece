// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/aim_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>

#include "lightcal/fit/model/off_axis.h"
#include "lightcal/light/lamp_axes.h"

namespace lightcal::fit {
namespace {

// Of what was read, by 1 sigma of the aim: below it the meter's own scatter is more.
constexpr double kAimCounts = 0.005;
// No light is less than this part of what the stated aim gives: its logarithm has to end.
constexpr double kLeastPart = 1e-4;

bool HasAim(const LightDescription& light) {
  return light.distribution || light.kind == LightKind::kDisk || light.kind == LightKind::kRect ||
         (light.kind == LightKind::kSpot && light.outer);
}

// By its place, the lamp's aim stated.
std::optional<LightByTilt> LightByPlace(const LightDescription& light, const Observation& row) {
  if (!light.aim || !light.position_m || !row.position_m || !row.measured_from_center) {
    return std::nullopt;
  }
  if (row.off_axis) {
    return [light, row](double x, double y) {
      LightDescription there = light;
      const TiltedAim tilted = Tilt(light, x, y);
      there.aim = tilted.aim;
      there.axis = tilted.c0;
      return EmissionBefore(*PlacedSourceOf(there), there.kind, row);
    };
  }
  if (!light.distribution) return std::nullopt;
  const Vec3 way = *row.position_m - *light.position_m;
  return [light, way](double x, double y) {
    const TiltedAim tilted = Tilt(light, x, y);
    const LampAxes axes = AxesOfAim(tilted.aim, tilted.c0);
    const Vec3 towards = {Dot(way, axes.c0), Dot(way, axes.c90), -Dot(way, axes.aim)};
    return light.distribution->Towards(towards, TableInterpolation::kCubic).value();
  };
}

// All angles are in one plane, in which x tilts.
LightByTilt LightByAngle(const LightDescription& light, const Observation& row) {
  return [light, distance = row.distance_m, off = row.off_axis_rad](double x, double y) {
    return LightRoundAbout(light, distance, std::hypot(off + x, y));
  };
}

}  // namespace

TiltedAim Tilt(const LightDescription& light, double x, double y) {
  const LampAxes axes =
      AxesOfAim(light.aim.value_or(Vec3{0.0, 0.0, -1.0}), light.axis.value_or(Vec3{}));
  const Vec3 aim = axes.aim + axes.c0 * x + axes.c90 * y;
  const LampAxes tilted = AxesOfAim(aim, axes.c0);
  return {tilted.aim, tilted.c0};
}

void LetAimMove(const LightDescription& light, Observations& observations) {
  const double sd = std::tan(AngleSigma(light).value());
  if (!HasAim(light) || !(sd > 0.0)) return;
  const bool by_angles = std::ranges::any_of(
      observations.rows, [](const Observation& o) { return o.lit && o.off_axis_rad != 0.0; });
  bool counts = false, in_space = false;
  for (Observation& row : observations.rows) {
    if (!row.lit) continue;
    std::optional<LightByTilt> shines = LightByPlace(light, row);
    in_space = in_space || shines;
    if (!shines && by_angles && AxisIsSought(light)) shines = LightByAngle(light, row);
    if (!shines) continue;
    const double stated = (*shines)(0.0, 0.0);
    if (!(stated > 0.0)) continue;
    const auto part = [shines = *std::move(shines), stated](double x, double y) {
      return std::max(kLeastPart, shines(x, y) / stated);
    };
    for (const double tilt : {-sd, sd}) {
      counts = counts || std::abs(part(tilt, 0.0) - 1.0) > kAimCounts ||
               std::abs(part(0.0, tilt) - 1.0) > kAimCounts;
    }
    row.by_aim = std::make_shared<const LightByTilt>(part);
  }
  if (counts) {
    // Across the plane of the angles its square counts, which has mean and sd of N(0, sd)'s.
    observations.aim[0] = {true, 0.0, sd};
    observations.aim[1] =
        in_space ? observations.aim[0] : ParameterRule{true, sd, sd / std::numbers::sqrt2};
    return;
  }
  for (Observation& row : observations.rows) row.by_aim.reset();
}

}  // namespace lightcal::fit
