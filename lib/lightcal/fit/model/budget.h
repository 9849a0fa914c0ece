// SPDX-License-Identifier: Apache-2.0
// Where an intensity's uncertainty comes from, and what would halve each part.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lightcal/fit/model/uncertainty.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::fit {

// One cause of the variance of ln I.
struct VariancePart {
  std::string name;
  double variance = 0.0;
};

// What the readings, the instruments' calibrations, the distance offset, the ambient light and each
// considered influence add to the variance of ln I of EstimateCovariance: each is what the variance
// gains when it is let in, in that order. The parts add up to the whole. Empty where the readings
// determine nothing.
[[nodiscard]] std::vector<VariancePart> VarianceParts(const UncertaintyInput& input);

// The same of any estimate of which only the variance of ln I with given influences is known.
[[nodiscard]] std::vector<VariancePart> VarianceParts(
    std::string base, const std::vector<Consider>& considered,
    const std::function<double(const std::vector<Consider>&)>& variance);

// Parts of one name added up, largest first, with their shares and what would halve them; parts
// below a millionth of the whole are left out.
[[nodiscard]] std::vector<BudgetPart> BudgetOf(const std::vector<VariancePart>& parts);

}  // namespace lightcal::fit
