// SPDX-License-Identifier: Apache-2.0
// What of a reading came off the walls, as a fit has it.
#pragma once

#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal {

// In lux: what the fit predicts for the row less what the lamp alone gives there
// (PredictIlluminance, times cos of the tilt). 0 where the session has no walls, and for rows that
// were taken at places or behind no card: there the lamp alone is not known from its distance.
[[nodiscard]] double WallPartOf(const Session& session, const FittedLight& lamp,
                                const ResidualRow& row);

}  // namespace lightcal
