// SPDX-License-Identifier: Apache-2.0
// A lamp whose shape its readings off the axis tell, as a FittedLight.
#pragma once

#include <optional>

#include "lightcal/core/result.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Absent where it turns out to have no shape of its own: it shines alike in all directions, or as a
// spot's cone, which its own fit takes on. `out`: described, with its colour. Warnings and notes go
// to `session_out`.   Refused: as FitBeamLight, PlanForward and CheckKnown.
[[nodiscard]] Result<std::optional<FittedLight>> FitProfile(
    const Session& session, const LightDescription& light, const Observations& observations,
    const FitSettings& settings, FittedLight out, FittedSession& session_out);

}  // namespace lightcal::fit
