// SPDX-License-Identifier: Apache-2.0
// A source whose every point shines in a narrow beam: near it, the rim aims past the meter.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "lightcal/light/effects/effect.h"
#include "lightcal/light/effects/finite_source.h"

namespace lightcal::effects {

// n of the beam cos^n t with half its peak at `half_angle`.
[[nodiscard]] inline double BeamExponent(double half_angle) {
  return std::log(0.5) / std::log(std::cos(half_angle));
}

// Illuminance on the axis of a disk that shines as cos^n, over a point's, y = (R/d)^2:
//   2/((n + 1) y) (1 - (1 + y)^(-(n + 1)/2))   ->  1 - (n + 3)/4 y
[[nodiscard]] inline double BeamFactor(double exponent, double y) {
  const double n1 = exponent + 1.0;
  if (n1 * y < 1e-9) return 1.0 - 0.25 * (exponent + 3.0) * y;
  return -2.0 / (n1 * y) * std::expm1(-0.5 * n1 * std::log1p(y));
}

// |true/point - 1| of the same disk off its axis: with m = n + 3, s the sine of the angle off the
// axis and t the meter's tilt, in whatever direction,
//   y m (|m s^2 - 2|/8 + s tan(t)/4)  and the square of y m (m s^2 + 2)/8 for the terms beyond.
[[nodiscard]] inline double OffAxisBeamBound(double exponent, double y, const ScenePose& pose) {
  const double m = exponent + 3.0;
  const double s = std::sin(pose.emission_rad);
  const double rest = y * m * (m * s * s + 2.0) / 8.0;
  return y * m * (std::abs(m * s * s - 2.0) / 8.0 + 0.25 * s * std::tan(pose.tilt_rad)) +
         rest * rest;
}

//   bound = min(1, 1/BeamFactor - 1) for a beam cos^n of a disk of radius R on its axis, y =
//   (R/d)^2
//   ((n + 3)/4 y far away), off it OffAxisBeamBound; the largest of the readings.
[[nodiscard]] inline EffectFinding FindNarrowBeam(const Scene& scene) {
  if (scene.kind != LightKind::kSpot && scene.kind != LightKind::kPoint &&
      scene.kind != LightKind::kDisk) {
    return NotApplicable("this kind has no beam");
  }
  std::optional<double> half;
  if (scene.beam) half = 0.5 * scene.beam->value();
  if (!half && scene.outer)
    half = 0.5 * (scene.outer->value() + scene.inner.value_or(Radians(0)).value());
  if (!half || !(*half > 0.0) || *half >= RadiansFromDegrees(80.0).value()) {
    return {0.0, Treatment::kFitted, 0.0,
            scene.kind == LightKind::kSpot
                ? "no beam_deg or cone given; the distance offset takes it up"
                : "no narrow beam stated"};
  }
  const std::optional<double> radius = SourceRadius(scene);
  const double exponent = BeamExponent(*half);
  double bound = 0.0;
  for (const ScenePose& pose : scene.poses) {
    const double ratio = radius.value_or(kRadiusDefault) / pose.distance_m;
    const double y = ratio * ratio;
    bound = std::max(bound, pose.emission_rad > kOnAxis_rad ? OffAxisBeamBound(exponent, y, pose)
                                                            : 1.0 / BeamFactor(exponent, y) - 1.0);
  }
  return {std::min(1.0, bound), Treatment::kFitted, 0.0,
          radius ? "of such a beam and size; the distance offset takes up what remains"
                 : "of such a beam, of a 6 cm lamp; the distance offset takes up what remains"};
}

}  // namespace lightcal::effects
