// SPDX-License-Identifier: Apache-2.0
// How other light drifts from one reading to the next.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "lightcal/records/reading_plan.h"

namespace lightcal::fit {

// A shadow-card or lamp-off reading of another place still tells the ambient light, but bounce
// differs from place to place.
inline constexpr double kSigmaElsewhere = 0.3;

// Other light that nobody names may be daylight: of the sun 30 degrees high, that climbs a quarter
// of a degree a minute, cot(30) x .25 degrees = .75 % a minute.
inline constexpr double kDriftAMinute = 0.0075;

// Of other light between two readings, 1 sigma, relative: by their times in seconds, else by what a
// person takes from one to the next, one of them behind a card; never more than of another place.
[[nodiscard]] inline double DriftBetween(std::optional<double> a, std::optional<double> b,
                                         bool card) {
  const double usual = card ? MeasuringMinutes().card : MeasuringMinutes().reading;
  const double minutes = a && b ? std::abs(*a - *b) / 60.0 : usual;
  return std::min(kDriftAMinute * minutes, kSigmaElsewhere);
}

}  // namespace lightcal::fit
