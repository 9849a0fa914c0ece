// SPDX-License-Identifier: Apache-2.0
// What a data sheet's angles alone say of a spot that nobody read off its axis.
#pragma once

#include <optional>

#include "lightcal/light/beam_ensemble.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// The beams of a spot whose beam is stated, and no cone (BeamEnsemble); absent of others.
[[nodiscard]] std::optional<BeamSolidAngles> BeamsOf(const LightDescription& light);

// A spot of a stated beam angle, without a cone and without a reading off its axis, gets the beam
// itself as its distribution (BeamOf, light/beam_ensemble.h), as bright as found and of the flux
// beside it; OfStatedBeam tells it from a measured one.
void ShapeByStatedBeam(const LightDescription& light, FittedLight& out);

// A spot of a stated outer angle alone that nobody read gets the inner angle that carries its flux
// at its intensity, open between 0 and the outer one.
void FindInnerByFlux(const LightDescription& light, FittedLight& out);

}  // namespace lightcal::fit
