// SPDX-License-Identifier: Apache-2.0
// A spot whose cone is stated by its edge alone: how far its even middle reaches nobody says.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Whether it is such a spot, and no fit of its own seeks the cone (NeedsBeam).
[[nodiscard]] bool LacksInner(const LightDescription& light, const Observations& observations);

// FitByDistance with inner_deg held at nine shares of outer_deg, all alike likely before the
// readings, weighed by what these and a printed flux say of each: exp(-chi^2/2)/prod sigma.
// Intensity and flux are the mixture's, inner_deg its mean, all else of the likeliest. Refused: as
// FitByDistance for all of them.
[[nodiscard]] Result<FittedLight> FitUnstatedInner(
    const Session& session, const LightDescription& light, const Observations& observations,
    const FitSettings& settings, const FittedLight& described, FittedSession& session_out);

}  // namespace lightcal::fit
