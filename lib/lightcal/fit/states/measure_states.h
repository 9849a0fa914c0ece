// SPDX-License-Identifier: Apache-2.0
// The states of one lamp's controls that were read: its light at each over that at the reference.
#pragma once

#include "lightcal/colorimetry/cct_approximations.h"
#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// light: fitted at its reference state (Session::readings hold no other). Sets light.state and
// light.states: of each state the mean over its readings of
//   k = (E - E0)/(E_ref - E0),   ln k of variance s^2/n + s_ref^2/n_ref + (d E0/E)^2,
// E_ref being what the reference's readings at the same place showed (its scale, the walls and the
// offset cancel), at that moment where they have times (fit/states/drift.h), or where none was
// taken there what the fit predicts (predicted_reference, warned of as
// reference_predicted beyond 2 %); E0 what was read there with the lamp off, or elsewhere, or
// behind a card. Where nothing was, and the room is not dark, E0 is 0 within 2.5 % of the dimmest
// reading, 1 sigma, as of other lamps everywhere. s is the meter's repeatability. Intensity and
// illuminance are the reference's times k. A state whose readings cannot be told from E0, or that
// hold colour alone, has the warning state_dark or state_without_light and no row.
void MeasureStates(const Session& session, const LightDescription& description,
                   CctMethod cct_method, FittedLight& light, Warnings& warnings);

}  // namespace lightcal::fit
