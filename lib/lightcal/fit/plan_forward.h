// SPDX-License-Identifier: Apache-2.0
// Session -> scene -> effect gate -> the forward model that the estimate uses.
#pragma once

#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/observations.h"

namespace lightcal::fit {

struct ForwardPlan {
  ForwardModel model;
  std::vector<EffectReport> effects;  // as the gate decided; contributions are found after the fit
};

[[nodiscard]] Result<ForwardPlan> PlanForward(const Session& session, const LightDescription& light,
                                              const Observations& observations,
                                              const FitSettings& settings);

// The plan's effects with what each contributed at the nearest reading, found by the estimate.
[[nodiscard]] std::vector<EffectReport> ReportEffects(const ForwardPlan& plan,
                                                      const Observations& observations,
                                                      const LightEstimate& estimate);

}  // namespace lightcal::fit
