// SPDX-License-Identifier: Apache-2.0
// States whose light no dimmer gives beside the others: a digit too many, another state's number.
#pragma once

#include <optional>

#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::fit {

// ln of a fixture's light at a dimmer, 0 to 100.
struct DimmedLight {
  double dimmer = 0.0, ln = 0.0;
};
struct LnRange {
  double low = 0.0, high = 0.0;
};
// ln of the light at a dimmer between two, as lines over the dimmer and over its logarithm have it;
// absent where one is not above 0.
[[nodiscard]] std::optional<LnRange> LnBetween(const DimmedLight& below, const DimmedLight& above,
                                               double dimmer);

// Of the light's states along the dimmer, all other controls alike:
//   state_not_monotonic  one is brighter than a state of a higher dimmer, by more than 10 % and 5
//                        of their own sigmas
//   state_out_of_line    one lies between its neighbours, yet a factor of 4 and twice the interval
//                        from what the others say of it (AnswerWithout)
// Both name the state whose removal mends it, and the power of ten that would.
void WarnOfDoubtedStates(const FittedLight& light, Warnings& warnings);

}  // namespace lightcal::fit
