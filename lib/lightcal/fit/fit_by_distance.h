// SPDX-License-Identifier: Apache-2.0
// A lamp read along its axis, or in a spot's cone, as a FittedLight.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// The cone first, where it is sought; then intensity, offset, walls and other light by how the
// readings fall with distance (EstimateLight), once more where the offset found calls for effects
// that the gate had left off. `out`: described, with its colour. Warnings and notes go to
// `session_out`.
// Refused: no_valid_readings, and as FitSpotBeam, CheckUnits, CheckFalloff, PlanForward,
// EstimateLight and CheckKnown.
[[nodiscard]] Result<FittedLight> FitByDistance(const Session& session,
                                                const LightDescription& light,
                                                Observations observations,
                                                const FitSettings& settings, FittedLight out,
                                                FittedSession& session_out);

}  // namespace lightcal::fit
