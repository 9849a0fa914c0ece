// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/projected_spot.h"

#include <algorithm>
#include <cmath>

#include "lightcal/core/units.h"

namespace lightcal {
namespace {

constexpr double kWidest = 80.0 * kRadiansPerDegree;

// Towards a direction at tan(angle) = `aside`.
double BeamAt(const SpotCone& cone, double aside) {
  return SpotAttenuation(Radians(std::atan(std::abs(aside))), cone, SpotFalloff::kSquaredLinear);
}

}  // namespace

std::optional<ProjectedSpot> ProjectionOf(const SpotCone& cone) {
  constexpr int kAngles = 400, kPlaces = 8;
  const double outer = cone.outer.value();
  if (outer > kWidest) return std::nullopt;
  ProjectedSpot out;
  out.half_angle = Radians(1.03 * outer + 0.005);
  // Along a row two texels stand a step apart; which directions they show turns with the roll, so
  // the worst of their places counts. Aslant to the rows four texels stray less than two.
  const double step = 2.0 * std::tan(out.half_angle.value()) / kProjectedTexels;
  const double from = std::max(0.0, std::tan(std::min(cone.inner.value(), outer)) - 2.0 * step);
  const double to = std::tan(outer) + 2.0 * step;
  for (int i = 0; i <= kAngles; ++i) {
    const double aside = from + (to - from) * i / kAngles;
    const double beam = BeamAt(cone, aside);
    for (int k = 0; k < kPlaces; ++k) {
      const double part = static_cast<double>(k) / kPlaces;
      const double low = aside - part * step;
      const double shown = (1.0 - part) * BeamAt(cone, low) + part * BeamAt(cone, low + step);
      if (std::abs(shown - beam) <= out.worst) continue;
      out.worst = std::abs(shown - beam);
      out.worst_at = Radians(std::atan(aside));
    }
  }
  return out;
}

}  // namespace lightcal
