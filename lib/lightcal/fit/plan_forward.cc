// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/plan_forward.h"

namespace lightcal::fit {

Result<ForwardPlan> PlanForward(const Session&, const LightDescription& light, const Observations&,
                                const FitSettings&) {
  ForwardPlan plan;
  plan.model.distance_law = HasDistanceLaw(light.kind);
  plan.model.shape = AxialShapeOf(
      light.kind, {light.diameter, light.width, light.height, light.length, light.radius});
  return plan;
}

std::vector<EffectReport> ReportEffects(const ForwardPlan& plan, const Observations&,
                                        const LightEstimate&) {
  return plan.effects;
}

}  // namespace lightcal::fit
