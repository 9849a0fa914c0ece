// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/stated_beam.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/fit/beam/beam_rows.h"
#include "lightcal/records/stated_beam.h"

namespace lightcal::fit {
namespace {

// Nodes so near that straight lines between them carry the beam's flux to about 0.1 %.
constexpr double kNodesToHalf = 30.0;
constexpr double kWidestStep_deg = 1.0;

bool IsBareSpot(const FittedLight& out) {
  return out.kind == LightKind::kSpot && !out.distribution && out.flux_lm && out.intensity_cd &&
         out.intensity_cd->value > 0.0;
}

// Beams of those angles differ, and lamps from the angles of their data sheets.
std::vector<double> PatternOfStated(const LightDescription& light, const RelativeIntensity& drawn,
                                    const MeasuredDistribution& distribution) {
  const RelativeIntensity of_beams = DoubtOfBeams(*light.beam, light.field, drawn);
  std::vector<double> out;
  for (const double degrees : distribution.table.grid().vertical_deg) {
    const Radians at = RadiansFromDegrees(degrees);
    const double of_angle =
        0.5 * (drawn(at / (1.0 + kSheetAngle)) - drawn(at * (1.0 + kSheetAngle)));
    out.push_back(std::hypot(of_beams(at), of_angle));
  }
  return out;
}

}  // namespace

std::optional<BeamSolidAngles> BeamsOf(const LightDescription& light) {
  const bool alone =
      light.kind == LightKind::kSpot && light.beam && !light.outer && !light.distribution;
  if (!alone) return std::nullopt;
  const auto beams = BeamEnsemble(*light.beam, light.field);
  return beams ? std::optional(*beams) : std::nullopt;
}

void ShapeByStatedBeam(const LightDescription& light, FittedLight& out) {
  if (!IsBareSpot(out) || light.outer || !light.beam) return;
  const double candela = out.intensity_cd->value;
  const auto beam = BeamOf(*light.beam, light.field, Steradians(out.flux_lm->value / candela));
  if (!beam) return;
  const double half = 0.5 * DegreesFromRadians(*light.beam);
  const double step = std::min(half / kNodesToHalf, kWidestStep_deg);
  IntensityGrid grid;
  grid.horizontal_deg = {0.0};
  for (double at = 0.0; at < 90.0 - 0.5 * step; at += at < 3.0 * half ? step : kWidestStep_deg) {
    grid.vertical_deg.push_back(at);
  }
  grid.vertical_deg.push_back(90.0);
  for (const double at : grid.vertical_deg) {
    grid.candela.push_back(candela * (*beam)(RadiansFromDegrees(at)));
  }
  auto table = IntensityTable::Make(std::move(grid), light.name);
  if (!table) return;
  out.distribution = MeasuredDistribution{*std::move(table)};
  out.distribution->pattern_sd = PatternOfStated(light, *beam, *out.distribution);
  out.beam = MeasuredBeam{};
  out.beam->families = {{std::string(kStatedBeam), 1.0, 0.0}};
}

// Phi/I = 2 pi [(1 - ci) + (ci - co)/3] of the squared-linear cone, solved for ci.
void FindInnerByFlux(const LightDescription& light, FittedLight& out) {
  if (!IsBareSpot(out) || !light.outer || light.inner) return;
  const double co = std::cos(light.outer->value());
  const double part = out.flux_lm->value / out.intensity_cd->value / (2.0 * std::numbers::pi);
  const double ci = std::clamp(1.5 * (1.0 - co / 3.0 - part), co, 1.0);
  const double inner = DegreesFromRadians(Radians(std::acos(ci)));
  const double outer = DegreesFromRadians(*light.outer);
  out.inner_deg = std::min(inner, outer);
  out.inner_u95_deg = std::max(inner, outer - inner);
}

}  // namespace lightcal::fit
