// SPDX-License-Identifier: Apache-2.0
// Intervals by sampling where the settings ask for them, and what the samples found.
#pragma once

#include <optional>
#include <string>

#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/monte_carlo.h"

namespace lightcal::fit {

// Absent: the covariance alone is asked for.
[[nodiscard]] std::optional<SamplingRule> SamplingOf(const FitSettings& settings);

// How many samples were drawn and how far their 95 % lie from the covariance's, as a sentence.
[[nodiscard]] std::string SayOfSampling(const LightEstimate& estimate, const std::string& light);

}  // namespace lightcal::fit
