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
// spot's cone, which its own fit takes on. A data sheet's beam_deg and field_deg are left out where
// the readings alone know the angle, and it is another by two standard deviations of both
// (data_sheet_disagrees). `out`: described, with its colour. Warnings and notes go to
// `session_out`.   Refused: as FitBeamLight, PlanForward and CheckKnown.
[[nodiscard]] Result<std::optional<FittedLight>> FitProfile(
    const Session& session, const LightDescription& light, const Observations& observations,
    const FitSettings& settings, FittedLight out, FittedSession& session_out);

// Whether readings off the axis lie on the cone that the session states (outer_deg, with or without
// inner_deg; f of photometry/spot_profile.h). Refused: cone_unlike, where the shape that they show
// by themselves, as wide and as sure as it is, differs from it by more than 15 % of the peak where
// one of them was taken; 4 % where no cone is likely; and where the cone's own fit has not
// `answered` but they do by themselves. Where they show no shape nothing is said.
[[nodiscard]] Result<void> CheckStatedCone(const Session& session, const LightDescription& light,
                                           const Observations& observations,
                                           const FitSettings& settings, bool answered);

}  // namespace lightcal::fit
