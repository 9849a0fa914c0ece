// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/fit_profile.h"

#include <algorithm>
#include <utility>

#include "lightcal/fit/beam/beam_light.h"
#include "lightcal/fit/beam/spot_beam.h"
#include "lightcal/fit/model/asked_sampling.h"
#include "lightcal/fit/model/data_sheet.h"
#include "lightcal/fit/model/fill_light.h"
#include "lightcal/fit/model/meter_calibration.h"
#include "lightcal/fit/model/reading_times.h"
#include "lightcal/fit/plan/plan_forward.h"

namespace lightcal::fit {
namespace {

// Calibration is one factor on every reading.
void WidenBeam(double calibration, BeamLight& found) {
  AddCalibration(calibration, found.estimate);
  WidenInLn(found.flux_lm, 1.0, calibration);
  WidenInLn(*found.beam.axial, 1.0, calibration);
}

}  // namespace

Result<std::optional<FittedLight>> FitProfile(const Session& session, const LightDescription& light,
                                              const Observations& observations,
                                              const FitSettings& settings, FittedLight out,
                                              FittedSession& session_out) {
  LightDescription seen = light;
  seen.beam = RoughBeam(observations, light);
  Result<ForwardPlan> plan = PlanForward(session, seen, observations, settings);
  if (!plan) return Propagate(std::move(plan));
  Result<BeamLight> found = FitBeamLight(observations, light, plan->model);
  // A cone and a bulb have fits of their own, which may still answer.
  const bool stated = std::ranges::any_of(
      observations.rows, [](const Observation& o) { return o.off_axis_rad != 0.0; });
  const bool bulb_by_places = light.kind == LightKind::kPoint && !stated;
  if (!found && (bulb_by_places || NeedsBeam(observations, light))) return std::nullopt;
  if (!found) return Propagate(std::move(found));
  if (bulb_by_places && !found->surely_a_beam) return std::nullopt;
  if (found->even || (found->flat_cone && NeedsBeam(observations, light))) return std::nullopt;
  if (auto known = CheckKnown(found->estimate, light.name); !known) {
    return Propagate(std::move(known));
  }
  WidenBeam(SharedCalibration(observations), *found);
  LightEstimate& estimate = found->estimate;
  if (SamplingOf(settings)) session_out.notes.push_back(SayOfSampling(estimate, light.name));
  FillParameters(estimate, true, out);
  out.fit = estimate.diagnostics;
  out.residuals = estimate.residuals;
  out.effects = ReportEffects(*plan, observations, estimate);
  ReportCalibration(observations, out.effects);
  out.budget = BudgetWithScale(observations, estimate.variance_parts);
  session_out.Warn(std::move(estimate.warnings));
  FillBeamLight(*std::move(found), out);
  CheckDataSheet(light, out.intensity_cd, session_out.warnings);
  CheckDrift(session, out, session_out.warnings);
  return out;
}

}  // namespace lightcal::fit
