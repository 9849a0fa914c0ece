// SPDX-License-Identifier: Apache-2.0
// How finely a meter's display shows, as the figures read off it say.
#pragma once

#include <map>
#include <string>

#include "lightcal/records/session.h"

namespace lightcal {

// The coarsest step of 1, .1, .01 ... lx of which all illuminances are multiples that the session
// has of that reading's instrument, or of 10 lx where three different ones are, of 5 where four:
// no lamp gives so many round figures; else of 1 to .001 fc. What its [[meter]] states, if it does.
// 0 for what no display showed: a data sheet, a picture, a connected meter (its sigma holds its
// last digit). [lx]
[[nodiscard]] double DisplayStepOf(const Session& session, const Reading& like);
// That of each instrument that showed a figure, by InstrumentOf: for Session::display_steps of a
// part.
[[nodiscard]] std::map<std::string, Lux> DisplaySteps(const Session& session);

// From so many steps on a reading's repeatability, a hundredth unless stated, holds its last digit.
inline constexpr double kStepsEnough = 20.0;
// 1 sigma of a figure rounded to that step: step / sqrt(12).
[[nodiscard]] double SigmaOfDisplay(double step);

}  // namespace lightcal
