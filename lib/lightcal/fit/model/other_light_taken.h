// SPDX-License-Identifier: Apache-2.0
// What shone beside the lamp, taken from its readings: other lamps, and what was read behind a card
// or with the lamp off.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/fit/model/observations.h"

namespace lightcal::fit {

// No meter repeats better than this, relative; keeps a sigma of 0 from deciding alone.
inline constexpr double kLeastSigma = 1e-4;

// What stands behind an Observation.
struct ReadingBehind {
  double sigma = 0.0;          // 1 sigma, relative
  double last_digit_lx = 0.0;  // 1 sigma
  bool shadow = false;
  bool no_place = false;  // an off or shadow reading without a distance
  const SessionReading* source = nullptr;
  double drift_lx = 0.0;  // of other light, until it was read alone; 1 sigma
  std::optional<double> seconds{};
};

// Fills measured_lx and sigma_lx of every row (CollectObservations says by what rules) and drops
// the rows that were subtracted. `behind`: of each row. Refused: not_separated, dark_above_lit.
[[nodiscard]] Result<void> TakeOtherLight(const LightDescription& light,
                                          std::vector<ReadingBehind> behind,
                                          Observations& observations);

}  // namespace lightcal::fit
