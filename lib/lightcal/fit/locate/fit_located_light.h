// SPDX-License-Identifier: Apache-2.0
// A lamp at an unknown place, as a FittedLight.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Found once for the gate to see its distances, and again with what the gate then models. `out`:
// described, with its colour. Warnings and notes go to `session_out`.
// Refused: as LocateLamp, PlanForward and CheckKnown.
[[nodiscard]] Result<FittedLight> FitLocatedLight(const Session& session,
                                                  const LightDescription& light,
                                                  const Observations& observations,
                                                  const FitSettings& settings, FittedLight out,
                                                  FittedSession& session_out);

}  // namespace lightcal::fit
