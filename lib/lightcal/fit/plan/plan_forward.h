// SPDX-License-Identifier: Apache-2.0
// Session -> scene -> effect gate -> the forward model that the estimate uses.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/budget.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/light/gate.h"

namespace lightcal::fit {

struct ForwardPlan {
  ForwardModel model;
  Scene scene;
  std::vector<GatedEffect> gated;
  // As the gate decided, without those this scene has nothing of; contributions are found after the
  // fit.
  std::vector<EffectReport> effects;
};

[[nodiscard]] Result<ForwardPlan> PlanForward(const Session& session, const LightDescription& light,
                                              const Observations& observations,
                                              const FitSettings& settings);

// What a lamp does in time while a wall that it lights is photographed, and the air on the way.
struct LampInPictures {
  std::vector<VariancePart> parts;
  std::vector<EffectReport> effects;
};

// `way_m`: from the lamp over the wall to the camera. `level_by_meter`: a meter told the level, so
// that no shutter's moment matters.   Fails: as GateEffects.
[[nodiscard]] Result<LampInPictures> FindLampInPictures(const Session& session,
                                                        const LightDescription& light,
                                                        const ScenePicture& picture, double way_m,
                                                        bool level_by_meter,
                                                        const FitSettings& settings);

// The plan anew with the distance offset found, where an effect that was left off has outgrown its
// share by it; absent where none has. The reasons of such effects say so.
[[nodiscard]] Result<std::optional<ForwardPlan>> PlanAfterFit(const ForwardPlan& plan,
                                                              const LightDescription& light,
                                                              const Observations& observations,
                                                              const FitSettings& settings,
                                                              const LightEstimate& estimate);

// The plan's effects with what each contributed at the nearest reading, found by the estimate.
[[nodiscard]] std::vector<EffectReport> ReportEffects(const ForwardPlan& plan,
                                                      const Observations& observations,
                                                      const LightEstimate& estimate);

}  // namespace lightcal::fit
