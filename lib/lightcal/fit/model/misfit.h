// SPDX-License-Identifier: Apache-2.0
// Readings that no lamp of the model can have made.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/prepare.h"
#include "lightcal/fit/model/robust.h"

namespace lightcal::fit {

// Probability that chi-squared with `dof` degrees of freedom exceeds `chi_squared` (Wilson and
// Hilferty 1931). dof >= 1/2.
[[nodiscard]] double ChiSquaredTail(double chi_squared, double dof);

// "reading 2 (58 lx at 1 m)", counted from 0 over the light's.
[[nodiscard]] std::string NameOfReading(const Observation& o);

// Whether lamp and meters are told by their places alone, and what to ask where these disagree.
[[nodiscard]] bool BetweenPlaces(const Observations& observations);
inline constexpr std::string_view kAskForPlaces =
    "do the lamp and the meters stand where their positions say? A place that pictures gave the "
    "lamp may be off: measure it; or leave it out, and five readings that are not on one line find "
    "it";

// Refused: model_misfit, where readings at three distances or more contradict every lamp under its
// priors (p < 1e-3) by more than three times their sigma and 4 % of their light, where half
// of them or neighbours on one side had to be thrown out, or where the offset they ask for
// stands at its bound. The message names the cause that explains the rest when tried: one reading,
// a distance in feet, a beam read off its axis, places that disagree, another lamp. Less than three
// times: the warning misfit; the interval holds it.
[[nodiscard]] Result<void> CheckMisfit(const RobustEstimate& estimate, const Estimation& all,
                                       const Prepared& prepared, const Observations& observations,
                                       const std::string& light, Warnings& warnings);

// Where the light was found to start, and its 1 sigma, metres.
struct FoundOffset {
  double metres = 0.0, sd_m = 0.0;
};

// Refused: model_misfit, where readings at no more than two distances, which any offset suits, ask
// for one that no such lamp has, four standard deviations from its fixture's, or, of an unknown
// one, over .3 m: a softbox that nobody called one starts there, but so does a distance that is
// wrong. At more distances, which bear one another out, only beyond .6 m as well. An unknown
// fixture's that only a softbox has is told: prior_conflict.
[[nodiscard]] Result<void> CheckOffset(const FoundOffset& found, const ForwardModel& model,
                                       int distances, const Observations& observations,
                                       const std::string& light, Warnings& warnings);

}  // namespace lightcal::fit
