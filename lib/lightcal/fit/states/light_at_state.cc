// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "lightcal/fit/states/geometry.h"
#include "lightcal/fit/states/ln_of.h"
#include "lightcal/fit/states/state_answer.h"

namespace lightcal {

bool HasItsGeometry(const FittedLight& light, const FixtureState& at) {
  return !light.distance_offset_m || fit::SameGeometry(light.state, at);
}

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
  out.color = answer->color;
  out.state = at;
  // Readings and their covariance are of the reference state.
  out.residuals.clear();
  out.covariance_lnI_d0_E0.reset();
  out.in_room.clear();
  out.budget.clear();
  out.states.clear();
  return out;
}

}  // namespace lightcal
