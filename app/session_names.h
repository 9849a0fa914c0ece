// SPDX-License-Identifier: Apache-2.0
// Names a person types, against those a session has.
#pragma once

#include <string>

#include "lightcal/core/did_you_mean.h"
#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

// The light that is named or, where none is, the only one there is. Refused: unknown_light; --light
// where several may be meant.
[[nodiscard]] Result<std::string> LightMeant(const Session& session, const std::string& named);
// Whether the session has this light, and this meter ("" and data_sheet are always there).
// Refused: unknown_light, unknown_meter, with what is meant instead.
[[nodiscard]] Result<void> CheckNames(const Session& session, const std::string& light,
                                      const std::string& meter);
// Whether a reading may join the others of its light: either all of them say what its controls
// stood at, and the same controls, or none does.  Refused: state_missing, state_controls.
[[nodiscard]] Result<void> CheckState(const Session& session, const Reading& reading);

}  // namespace lightcal::app
