// SPDX-License-Identifier: Apache-2.0
// A source whose every point shines in a narrow beam: near it, the rim aims past the meter.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// n of the beam cos^n t with half its peak at `half_angle`.
[[nodiscard]] inline double BeamExponent(double half_angle) {
  return std::log(0.5) / std::log(std::cos(half_angle));
}

//   bound = min(1, (n + 3)/4 (R/d)^2) for a beam cos^n of a disk of radius R at the nearest
//   reading.
[[nodiscard]] inline EffectFinding FindNarrowBeam(const Scene& scene) {
  if (scene.kind != LightKind::kSpot && scene.kind != LightKind::kPoint &&
      scene.kind != LightKind::kDisk) {
    return {0.0, Treatment::kFitted, 0.0, "this kind has no beam"};
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
  const double ratio = radius.value_or(0.03) / NearestDistance(scene);
  return {std::min(1.0, 0.25 * (BeamExponent(*half) + 3.0) * ratio * ratio), Treatment::kFitted,
          0.0,
          radius ? "beam and size stated; the distance offset takes up what remains"
                 : "beam stated, a 6 cm lamp assumed; the distance offset takes up what remains"};
}

}  // namespace lightcal::effects
