// SPDX-License-Identifier: Apache-2.0
// What a session's instruments leave of an intensity at best.
#pragma once

#include <optional>

#include "lightcal/records/session.h"

namespace lightcal::fit {

// `like`: a reading by the meter that would take the next.

// 1 sigma of what the calibrations of all instruments that read leave together, relative; 0 where
// the readings of one share nothing.
[[nodiscard]] double SharedCalibrationOf(const Session& session, const Reading& like);

// 1 sigma, relative, of the first light's intensity of which these readings and one more were all
// that is not known. None where a data sheet speaks too.
[[nodiscard]] std::optional<double> LeastDeviation(const Session& session, const Reading& like);

}  // namespace lightcal::fit
