// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <utility>

#include "lightcal/fit/states/ln_of.h"
#include "lightcal/fit/states/state_answer.h"

namespace lightcal {

namespace {

void TakeShape(GeometryOfState found, FittedLight& out) {
  const bool own = found.basis == GeometryBasis::kOwn;
  if (!own && found.basis != GeometryBasis::kBetween) return;
  StateGeometry& from = found.geometry;
  if (from.distance_offset_m) out.distance_offset_m = from.distance_offset_m;
  out.kind = from.kind;
  out.flux_lm = from.flux_lm;
  out.inner_deg = from.inner_deg;
  out.outer_deg = from.outer_deg;
  out.inner_u95_deg = from.inner_u95_deg;
  out.outer_u95_deg = from.outer_u95_deg;
  if (!own) return;
  out.luminance_nits = from.luminance_nits;
  out.diameter_m = from.diameter_m;
  out.width_m = from.width_m;
  out.height_m = from.height_m;
  out.length_m = from.length_m;
  out.radius_m = from.radius_m;
  out.distribution = std::move(from.distribution);
  out.beam = std::move(from.beam);
}

}  // namespace

Result<FittedLight> LightAtState(const FittedLight& light, const FixtureState& at) {
  using fit::Scaled;
  const auto answer = AnswerState(light, at);
  if (!answer) return tl::unexpected(answer.error());
  FittedLight out = light;
  const double ln = std::log(answer->relative.value);
  const double sd = fit::SdOfLn(answer->relative);
  out.intensity_cd = answer->intensity_cd;
  out.illuminance_lx = answer->illuminance_lx;
  out.flux_lm = Scaled(light.flux_lm, ln, sd);
  out.luminance_nits = Scaled(light.luminance_nits, ln, sd);
  if (out.beam) out.beam->axial = Scaled(out.beam->axial, ln, sd);
  if (out.distribution) out.distribution->table = out.distribution->table.Scaled(std::exp(ln));
  TakeShape(GeometryAt(light, at, answer->intensity_cd), out);
  out.color = answer->color;
  out.spectrum.reset();
  if (answer->spectrum) out.spectrum = answer->spectrum->spectrum;
  out.emitters.reset();
  out.state = at;
  // Readings and their covariance are of the reference state.
  out.residuals.clear();
  out.covariance_lnI_d0_E0.reset();
  out.in_room.clear();
  out.located.reset();
  out.budget.clear();
  out.states.clear();
  out.geometries.clear();
  return out;
}

}  // namespace lightcal
