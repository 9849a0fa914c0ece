// SPDX-License-Identifier: Apache-2.0
// What of a reading came off the walls, as a fit has it.
#pragma once

#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal {

// In lux: what the fit predicts for the row less what the lamp alone gives there
// (PredictIlluminance, times cos of the tilt). 0 where the session has no walls. Of rows that were
// taken at places the row's own walls_lx, for there the lamp alone is not known from its distance;
// off the axis that too, or what walls give on the axis at that distance.
[[nodiscard]] double WallPartOf(const Session& session, const FittedLight& lamp,
                                const ResidualRow& row);

// `there` is `reference` at a state of its controls (LightAtState). Gives it the rows, and the
// session the readings and the description, of that state alone, as if nothing else had been read
// of it; walls shine as at the reference, by as much as the lamp does. Returns how many rows.
int TakeReadingsOfState(const FittedLight& reference, FittedLight& there, Session& session);

}  // namespace lightcal
