// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/fit_by_distance.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lightcal/core/uncertain.h"
#include "lightcal/core/units.h"
#include "lightcal/fit/beam/spot_beam.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/aim_error.h"
#include "lightcal/fit/model/asked_sampling.h"
#include "lightcal/fit/model/budget.h"
#include "lightcal/fit/model/data_sheet.h"
#include "lightcal/fit/model/fill_light.h"
#include "lightcal/fit/model/input_checks.h"
#include "lightcal/fit/model/meter_calibration.h"
#include "lightcal/fit/model/off_axis.h"
#include "lightcal/fit/model/reading_times.h"
#include "lightcal/fit/model/uneven_light.h"
#include "lightcal/fit/plan/plan_forward.h"

namespace lightcal::fit {
namespace {

// A cone was found under one offset's prior, and in all its readings: the intensity keeps to both.
void KeepToBeam(ForwardModel& model) {
  model.offsets = {MatchedOffset(model.offsets)};
  model.judge_misfit = false;
}

// What is not known of the cone is not known of its axis's intensity.
void WidenByCone(double variance_of_ln, LightEstimate& estimate) {
  constexpr int kOfIntensity = kLnIntensity * kParameters + kLnIntensity;
  estimate.covariance[kOfIntensity] += variance_of_ln;
  for (LampInRoom& one : estimate.in_room) one.covariance[kOfIntensity] += variance_of_ln;
  estimate.variance_parts.push_back({"cone", variance_of_ln});
}

// Where the readings told it.
void TellAim(const LightEstimate& estimate, const LightDescription& light, FittedLight& out) {
  if (std::ranges::find(estimate.diagnostics.learned, "aim") ==
      estimate.diagnostics.learned.end()) {
    return;
  }
  if (!light.aim || !light.position_m) return;
  const TiltedAim found = Tilt(light, estimate.theta[kAimX], estimate.theta[kAimY]);
  out.aim = found.aim;
  // Where nobody said, it goes by the aim: straight down and nearly so are a quarter turn apart.
  if (light.distribution || light.kind == LightKind::kRect) out.axis = found.c0;
  const double sd = std::max(SdOf(estimate.covariance, kAimX), SdOf(estimate.covariance, kAimY));
  out.aim_u95_deg = kZ95 * DegreesFromRadians(Radians(sd));
}

}  // namespace

Result<FittedLight> FitByDistance(const Session& session, const LightDescription& light,
                                  Observations observations, const FitSettings& settings,
                                  FittedLight out, FittedSession& session_out) {
  Warnings& warnings = session_out.warnings;
  std::optional<SpotBeam> beam;
  if (NeedsBeam(observations, light)) {
    Result<SpotBeam> found = FitSpotBeam(observations, light);
    if (!found) return Propagate(std::move(found));
    beam = *found;
    FillBeam(*beam, light, out);
  }
  const LightDescription seen = beam ? WithBeam(light, *beam) : light;
  const int beyond = PlaceOnSource(seen, beam.has_value(), observations);
  if (!beam) LetAimMove(light, observations);
  if (observations.rows.empty()) {
    const auto rejected = std::ranges::find(observations.warnings, "row_rejected", &Warning::code);
    return Refused(
        "no_valid_readings", light.name,
        rejected == observations.warnings.end()
            ? "the lamp shines on none of the readings by the cone that was found"
            : "every reading of this light was rejected; the first because " + rejected->message);
  }
  if (auto units = CheckUnits(observations, light.name); !units) {
    return Propagate(std::move(units));
  }
  const bool distance_law = HasDistanceLaw(light.kind);
  // Across a beam that was found, illuminance falls by its shape more than by distance.
  if (distance_law && !beam) {
    if (auto falloff = CheckFalloff(observations, seen, warnings); !falloff) {
      return Propagate(std::move(falloff));
    }
  }
  session_out.Warn(std::move(observations.warnings));
  Result<ForwardPlan> plan = PlanForward(session, seen, observations, settings);
  if (!plan) return Propagate(std::move(plan));
  const std::optional<SamplingRule> sampling = SamplingOf(settings);
  const auto estimate_by = [&](ForwardModel& model) {
    if (beam) {
      KeepToBeam(model);
    } else if (distance_law) {
      model.sheet = SheetBeside(session, observations, light);
    }
    return EstimateLight(observations, model, light.name, beam ? std::nullopt : sampling);
  };
  Result<LightEstimate> estimate = estimate_by(plan->model);
  if (!estimate) return Propagate(std::move(estimate));
  Result<std::optional<ForwardPlan>> again =
      PlanAfterFit(*plan, seen, observations, settings, *estimate);
  if (!again) return Propagate(std::move(again));
  if (*again) {
    plan = **std::move(again);
    estimate = estimate_by(plan->model);
    if (!estimate) return Propagate(std::move(estimate));
  }
  if (beam) WidenByCone(beam->ln_intensity_extra_variance, *estimate);
  if (auto known = CheckKnown(*estimate, light.name); !known) return Propagate(std::move(known));
  if (sampling) session_out.notes.push_back(SayOfSampling(*estimate, light.name));
  session_out.Warn(std::move(estimate->warnings));
  if (beam) {
    estimate->diagnostics.used += beyond;
    estimate->diagnostics.learned.emplace_back("cone");
  }
  FillParameters(*estimate, distance_law, out);
  TellAim(*estimate, light, out);
  out.uneven = UnevenOf(observations, seen);
  if (TakenToShineEvenly(observations, seen)) {
    session_out.notes.push_back(SayThatItShinesEvenly(light.name));
  }
  out.fit = estimate->diagnostics;
  out.residuals = estimate->residuals;
  out.effects = ReportEffects(*plan, observations, *estimate);
  ReportCalibration(observations, out.effects);
  out.meter = MeterOf(session, light.name, observations);
  if (!estimate->upper_limit) {
    out.budget = BudgetWithScale(observations, estimate->variance_parts);
  }
  AddDerivedQuantities(seen, out);
  TellFlux(*estimate, seen, out);
  if (distance_law) CheckDataSheet(light, ByReadings(*estimate, out), warnings);
  CheckDrift(session, out, warnings);
  return out;
}

}  // namespace lightcal::fit
