// SPDX-License-Identifier: Apache-2.0
// What a reading may have been before somebody wrote it down wrongly. Internal to one_mistake.cc.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/vec3.h"
#include "lightcal/fit/model/observations.h"

namespace lightcal::fit {

// The reading as it would have been, and the share of all mistakes that lead from it to what was
// typed.
struct Correction {
  Vec3 position_m{};
  double lux_factor = 1.0;
  double share = 0.0;
  std::string text;  // "x = 0.12 m rather than 1.2"
};

// A digit or two neighbours, the sign, the decimal point, feet for metres, two axes; of the light a
// digit, the point, foot-candles for lux. Mistakes of other kinds have what is left of 1.
[[nodiscard]] std::vector<Correction> CorrectionsOf(const Observation& reading);

}  // namespace lightcal::fit
