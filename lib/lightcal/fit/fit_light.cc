// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/fit_light.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/beam/beam_light.h"
#include "lightcal/fit/beam/spot_beam.h"
#include "lightcal/fit/colour/fit_color.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/locate/locate.h"
#include "lightcal/fit/model/data_sheet.h"
#include "lightcal/fit/model/fill_light.h"
#include "lightcal/fit/model/input_checks.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/off_axis.h"
#include "lightcal/fit/model/reading_times.h"
#include "lightcal/fit/plan/plan_forward.h"
#include "lightcal/fit/states/measure_states.h"
#include "lightcal/fit/states/split_geometries.h"

namespace lightcal {
namespace {

using fit::kAmbient;
using fit::kLnIntensity;
using fit::kParameters;

void Append(Warnings& to, Warnings&& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

double Sd(const fit::Covariance& covariance, fit::Parameter k) {
  return std::sqrt(covariance[k * kParameters + k]);
}

std::optional<fit::SamplingRule> SamplingOf(const FitSettings& settings) {
  if (settings.monte_carlo) return fit::SamplingRule{};
  if (settings.estimator.interval_samples > 0) {
    return fit::JustSamples(settings.estimator.interval_samples);
  }
  return std::nullopt;
}

std::string SayOfSampling(const fit::LightEstimate& estimate, const std::string& light) {
  if (!estimate.sampled) {
    return light +
           ": no samples: its interval comes from the covariance (a place or cone was found "
           "too, or only an upper limit)";
  }
  const fit::SampledParameter& ln = estimate.sampled->parameters[kLnIntensity];
  const double middle = estimate.theta[kLnIntensity];
  const double linear = kZ95 * Sd(estimate.covariance, kLnIntensity);
  const auto percent = [](double ln_ratio) { return PercentText(std::expm1(ln_ratio), 3); };
  return light + ": " + std::to_string(estimate.sampled->samples) + " samples" +
         (estimate.sampled->stable ? "" : " (two digits would take more)") + ": 95 % from " +
         percent(ln.low - middle) + " to +" + percent(ln.high - middle) +
         "; the covariance alone says " + percent(-linear) + " to +" + percent(linear);
}

double LargestCalibration(const fit::Observations& observations) {
  double largest = 0.0;
  for (const fit::Observation& o : observations.rows) {
    if (o.lit) largest = std::max(largest, o.calibration);
  }
  return largest;
}

// One factor on every reading: ln I shifts by it, E0 grows with it.
void AddCalibration(double calibration, fit::LightEstimate& estimate) {
  const fit::Theta shift = {calibration, 0.0, calibration * estimate.theta[kAmbient]};
  for (int i = 0; i < kParameters; ++i) {
    for (int j = 0; j < kParameters; ++j) {
      estimate.covariance[i * kParameters + j] += shift[i] * shift[j];
    }
  }
}

// The one instrument that took every reading, if one did.
std::optional<MeterShare> MeterOf(const Session& session, const std::string& light,
                                  const fit::Observations& observations) {
  std::optional<MeterShare> meter;
  const double calibration = LargestCalibration(observations);
  for (const SessionReading& row : session.readings) {
    const Reading& reading = row.reading;
    if (reading.light != light || !reading.illuminance) continue;
    const std::string& name = InstrumentOf(reading);
    if (meter && meter->name != name) return std::nullopt;
    if (!meter) meter = MeterShare{name, calibration};
  }
  return calibration > 0.0 ? meter : std::nullopt;
}

// The part of the interval that more readings do not lower.
void ReportCalibration(const fit::Observations& observations, std::vector<EffectReport>& effects) {
  const double calibration = LargestCalibration(observations);
  if (!(calibration > 0.0)) return;
  EffectReport report;
  report.name = "meter_calibration";
  report.state = EffectState::kOn;
  report.bound = kZ95 * calibration;
  report.cost_ns = 1.0;
  report.key = "meter.sigma_relative";
  report.reason = "the meter's own scale, within " + PercentText(report.bound) +
                  ", widens the interval: repeating does not lower it, and it cancels in the "
                  "ratio of two lamps read with one meter";
  effects.push_back(std::move(report));
}

// An interval of more than a factor of 1000 each way says nothing, and its ends overflow.
constexpr double kMostSdOfLn = 3.5;

// Refused: underdetermined, out_of_range (a lamp that no number can hold).
Result<void> CheckKnown(const fit::LightEstimate& estimate, const std::string& light) {
  if (estimate.upper_limit) return {};
  if (!std::isnormal(std::exp(estimate.theta[kLnIntensity]))) {
    return Refused("out_of_range", light,
                   "illuminance and distance give an intensity that no number can hold; check "
                   "their units");
  }
  if (Sd(estimate.covariance, kLnIntensity) < kMostSdOfLn) return {};
  return Refused("underdetermined", light,
                 "the readings leave its strength open by more than a factor of 1000 each way: at "
                 "such distances an error of a centimetre decides; measure from farther away");
}

// The position found is where the light seems to start.
void NameOffsetFound(std::vector<EffectReport>& effects) {
  for (EffectReport& effect : effects) {
    if (effect.name != "distance_offset") continue;
    effect.state = EffectState::kOff;
    effect.contribution.reset();
    effect.reason = "the position found is where the light seems to start: it holds any offset";
  }
}

// Off its axis the finite size of a flat lamp changes what a meter sees by about as much as on it.
void WidenByShape(const fit::Observations& seen, fit::ForwardModel& model) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const fit::Observation& o : seen.rows) {
    if (o.lit) nearest = std::min(nearest, o.distance_m);
  }
  const double off = 1.0 - AxialShapeFactor(model.shape, nearest);
  if (off > 0.0) model.considered.push_back({off * nearest * nearest, -2.0, "finite_source"});
}

// Of a lamp whose place is sought, the light from the walls is not fitted: its prior's mean shines
// and its spread widens the interval.
void HoldWalls(const fit::Observations& seen, fit::ForwardModel& model) {
  if (model.walls.empty()) return;
  double lit = 0.0;
  double sd = 0.0;
  model.bounce_per_candela.clear();
  for (const fit::Observation& o : seen.rows) {
    double mean = 0.0;
    double square = 0.0;
    for (const WallHypothesis& one : model.walls) {
      const double median = WallsPerCandela(one.prior, o.distance_m);
      const double above = WallsPerCandela(one.prior, o.distance_m, 1.0);
      const double variance = std::pow(std::log(above / median), 2.0);
      mean += one.weight * median * std::exp(0.5 * variance);
      square += one.weight * median * median * std::exp(2.0 * variance);
    }
    const bool counts = o.lit && o.sees_walls && !o.differenced;
    model.bounce_per_candela.push_back(counts ? mean : 0.0);
    if (!counts) continue;
    lit += 1.0;
    sd += std::sqrt(std::max(0.0, square - mean * mean));
  }
  if (lit > 0.0) model.considered.push_back({sd / lit, 2.0, "room_bounce"});
  model.walls.clear();
}

// A lamp at an unknown place: found once for the gate to see its distances, and again with what the
// gate then models.
Result<FittedLight> FitLocated(const Session& session, const LightDescription& light,
                               const fit::Observations& observations, const FitSettings& settings,
                               FittedLight out, FittedSession& session_out) {
  Warnings& warnings = session_out.warnings;
  Result<fit::LampLocation> first = fit::LocateLamp(observations, light, fit::ForwardModel{});
  if (!first) return Propagate(std::move(first));
  LightDescription placed = light;
  placed.position_m = first->position_m;
  const fit::Observations seen = fit::PlaceObservations(observations, first->position_m);
  Result<fit::ForwardPlan> plan = fit::PlanForward(session, placed, seen, settings);
  if (!plan) return Propagate(std::move(plan));
  WidenByShape(seen, plan->model);
  HoldWalls(seen, plan->model);
  Result<fit::LampLocation> location = fit::LocateLamp(seen, light, plan->model, &*first);
  if (!location) return Propagate(std::move(location));
  if (auto known = CheckKnown(location->estimate, light.name); !known) {
    return Propagate(std::move(known));
  }
  Append(warnings, std::move(location->estimate.warnings));
  const double calibration = LargestCalibration(seen);
  AddCalibration(calibration, location->estimate);
  location->estimate.variance_parts.push_back({"meter_calibration", calibration * calibration});
  if (SamplingOf(settings)) {
    session_out.notes.push_back(SayOfSampling(location->estimate, light.name));
  }
  fit::FillParameters(location->estimate, true, out);
  out.distance_offset_m.reset();
  out.position_m = location->position_m;
  Vec3 u95{};
  for (std::size_t k = 0; k < 3; ++k) u95[k] = kZ95 * std::sqrt(location->covariance_m2[4 * k]);
  out.position_u95_m = u95;
  out.fit = location->estimate.diagnostics;
  out.residuals = location->estimate.residuals;
  out.effects = fit::ReportEffects(*plan, seen, location->estimate);
  out.budget = fit::BudgetOf(location->estimate.variance_parts);
  NameOffsetFound(out.effects);
  ReportCalibration(seen, out.effects);
  out.meter = MeterOf(session, light.name, seen);
  fit::AddDerivedQuantities(light, out);
  fit::CheckDataSheet(light, out, warnings);
  return out;
}

// Calibration is one factor on every reading.
void WidenBeam(double calibration, fit::BeamLight& found) {
  AddCalibration(calibration, found.estimate);
  found.estimate.variance_parts.push_back({"meter_calibration", calibration * calibration});
  WidenInLn(found.flux_lm, 1.0, calibration);
  WidenInLn(*found.beam.axial, 1.0, calibration);
}

// A lamp whose shape readings off its axis tell. Absent where it turns out to have none of its own:
// it shines alike in all directions, or as a spot's cone, which its own fit takes on.
Result<std::optional<FittedLight>> FitProfile(const Session& session, const LightDescription& light,
                                              const fit::Observations& observations,
                                              const FitSettings& settings, FittedLight out,
                                              FittedSession& session_out) {
  LightDescription seen = light;
  seen.beam = fit::RoughBeam(observations, light);
  Result<fit::ForwardPlan> plan = fit::PlanForward(session, seen, observations, settings);
  if (!plan) return Propagate(std::move(plan));
  Result<fit::BeamLight> found = fit::FitBeamLight(observations, light, plan->model);
  // A cone and a bulb have fits of their own, which may still answer.
  const bool stated = std::ranges::any_of(
      observations.rows, [](const fit::Observation& o) { return o.off_axis_rad != 0.0; });
  const bool bulb_by_places = light.kind == LightKind::kPoint && !stated;
  if (!found && (bulb_by_places || fit::NeedsBeam(observations, light))) return std::nullopt;
  if (!found) return Propagate(std::move(found));
  if (bulb_by_places && !found->surely_a_beam) return std::nullopt;
  if (found->even || (found->flat_cone && fit::NeedsBeam(observations, light))) return std::nullopt;
  if (auto known = CheckKnown(found->estimate, light.name); !known) {
    return Propagate(std::move(known));
  }
  WidenBeam(LargestCalibration(observations), *found);
  fit::LightEstimate& estimate = found->estimate;
  if (SamplingOf(settings)) session_out.notes.push_back(SayOfSampling(estimate, light.name));
  fit::FillParameters(estimate, true, out);
  out.fit = estimate.diagnostics;
  out.residuals = estimate.residuals;
  out.effects = fit::ReportEffects(*plan, observations, estimate);
  ReportCalibration(observations, out.effects);
  out.budget = fit::BudgetOf(estimate.variance_parts);
  Append(session_out.warnings, std::move(estimate.warnings));
  fit::FillBeamLight(*std::move(found), out);
  fit::CheckDataSheet(light, out, session_out.warnings);
  fit::CheckDrift(session, out, session_out.warnings);
  return out;
}

// A cone was found under one offset's prior, and in all its readings: the intensity keeps to both.
void KeepToBeam(fit::ForwardModel& model) {
  model.offsets = {MatchedOffset(model.offsets)};
  model.judge_misfit = false;
}

Result<FittedLight> FitOne(const Session& session, const LightDescription& light,
                           const FitSettings& settings, FittedSession& session_out) {
  Warnings& warnings = session_out.warnings;
  Result<fit::Observations> observations = fit::CollectObservations(session, light);
  if (!observations) return Propagate(std::move(observations));
  fit::CheckTimes(session, light, warnings);
  fit::CheckRoom(session, light, warnings);
  if (auto sized = fit::CheckLengths(session, light, warnings); !sized)
    return Propagate(std::move(sized));
  FittedLight out = fit::Describe(light);
  out.color = fit::FitColor(session, light, warnings, settings.cct_method);
  if (observations->rows.empty()) {
    if (observations->rejected.empty() && fit::HasDataSheet(light)) {
      if (auto filled = fit::FillFromDataSheet(light, out); !filled) {
        return Propagate(std::move(filled));
      }
      fit::AddDerivedQuantities(light, out);
      out.flux_lm =
          Uncertain{light.flux->value(), fit::kFluxToleranceRelative * light.flux->value(), {}, {}};
      return out;
    }
    return observations->rejected.empty()
               ? Refused("no_readings", light.name,
                         "the session holds no illuminance reading of this light; add one with "
                         "`{ReadMeter}`, or give flux_lm from its data sheet")
               : Refused("no_valid_readings", light.name,
                         "every reading of this light was rejected; the first because " +
                             observations->warnings.front().message);
  }
  if (fit::NeedsLocating(*observations, light)) {
    Append(warnings, std::move(observations->warnings));
    return FitLocated(session, light, *observations, settings, std::move(out), session_out);
  }
  if (fit::NeedsProfile(*observations, light)) {
    Result<std::optional<FittedLight>> shaped =
        FitProfile(session, light, *observations, settings, out, session_out);
    if (!shaped) return Propagate(std::move(shaped));
    if (*shaped) {
      Append(warnings, std::move(observations->warnings));
      return **std::move(shaped);
    }
  }
  std::optional<fit::SpotBeam> beam;
  if (fit::NeedsBeam(*observations, light)) {
    Result<fit::SpotBeam> found = fit::FitSpotBeam(*observations, light);
    if (!found) return Propagate(std::move(found));
    beam = *found;
    fit::FillBeam(*beam, light, out);
  }
  const int beyond = fit::PlaceOnSource(beam ? fit::WithBeam(light, *beam) : light,
                                        beam.has_value(), *observations);
  if (observations->rows.empty()) {
    return Refused("no_valid_readings", light.name,
                   "the lamp shines on none of the readings by its position_m, aim and size");
  }
  if (auto units = fit::CheckUnits(*observations, light.name); !units) {
    return Propagate(std::move(units));
  }
  const bool distance_law = fit::HasDistanceLaw(light.kind);
  // Across a beam that was found, illuminance falls by its shape more than by distance.
  if (distance_law && !beam) {
    if (auto falloff = fit::CheckFalloff(*observations, light.name, warnings); !falloff) {
      return Propagate(std::move(falloff));
    }
  }
  Append(warnings, std::move(observations->warnings));
  const LightDescription seen = beam ? fit::WithBeam(light, *beam) : light;
  Result<fit::ForwardPlan> plan = fit::PlanForward(session, seen, *observations, settings);
  if (!plan) return Propagate(std::move(plan));
  const std::optional<fit::SamplingRule> sampling = SamplingOf(settings);
  if (beam) KeepToBeam(plan->model);
  Result<fit::LightEstimate> estimate =
      fit::EstimateLight(*observations, plan->model, light.name, beam ? std::nullopt : sampling);
  if (!estimate) return Propagate(std::move(estimate));
  Result<std::optional<fit::ForwardPlan>> again =
      fit::PlanAfterFit(*plan, seen, *observations, settings, *estimate);
  if (!again) return Propagate(std::move(again));
  if (*again) {
    plan = **std::move(again);
    if (beam) KeepToBeam(plan->model);
    estimate =
        fit::EstimateLight(*observations, plan->model, light.name, beam ? std::nullopt : sampling);
    if (!estimate) return Propagate(std::move(estimate));
  }
  if (auto known = CheckKnown(*estimate, light.name); !known) return Propagate(std::move(known));
  if (sampling) session_out.notes.push_back(SayOfSampling(*estimate, light.name));
  Append(warnings, std::move(estimate->warnings));
  if (beam) {
    estimate->covariance[0] += beam->ln_intensity_extra_variance;
    for (LampInRoom& one : estimate->in_room) {
      one.covariance[0] += beam->ln_intensity_extra_variance;
    }
    estimate->variance_parts.push_back({"cone", beam->ln_intensity_extra_variance});
    estimate->diagnostics.used += beyond;
    estimate->diagnostics.learned.emplace_back("cone");
  }
  fit::FillParameters(*estimate, distance_law, out);
  out.fit = estimate->diagnostics;
  out.residuals = estimate->residuals;
  out.effects = fit::ReportEffects(*plan, *observations, *estimate);
  ReportCalibration(*observations, out.effects);
  out.meter = MeterOf(session, light.name, *observations);
  if (!estimate->upper_limit) out.budget = fit::BudgetOf(estimate->variance_parts);
  fit::AddDerivedQuantities(seen, out);
  if (distance_law) fit::CheckDataSheet(light, out, warnings);
  fit::CheckDrift(session, out, warnings);
  return out;
}

// Each zoom and front that tells where its light starts is a lamp of its own, and its states too.
Result<void> AddGeometries(const fit::GeometryParts& parts, const LightDescription& light,
                           const FitSettings& settings, FittedLight& fitted, FittedSession& out) {
  for (const Session& part : parts.others) {
    const FixtureState reference = ReferenceState(part, light.name);
    const LightDescription there = fit::DescriptionFromReadings(part, light, reference);
    Result<FittedLight> own = FitOne(part, there, settings, out);
    if (!own) return Propagate(std::move(own));
    fit::MeasureStates(part, there, settings.cct_method, *own, out.warnings);
    fit::TakeGeometry(*own, fitted);
  }
  fit::DescribeOtherGeometries(light, fitted);
  return {};
}

}  // namespace

Result<FittedSession> FitSession(const Session& session, const FitSettings& settings) {
  FittedSession out;
  std::optional<Error> nothing_read;
  for (const LightDescription& described : session.lights) {
    const LightDescription light =
        DescriptionAt(described, ReferenceState(session, described.name));
    Result<FittedLight> fitted = FitOne(session, light, settings, out);
    if (fitted) {
      const fit::GeometryParts parts = fit::SplitGeometries(session, light);
      const Session& read = parts.others.empty() ? session : parts.main;
      fit::MeasureStates(read, light, settings.cct_method, *fitted, out.warnings);
      auto added = AddGeometries(parts, light, settings, *fitted, out);
      if (!added) return Propagate(std::move(added));
      if (fitted->states.size() > 1) {
        out.notes.push_back(light.name + ": read at " + std::to_string(fitted->states.size()) +
                            " states of its controls; its intensity is that at " +
                            StateText(fitted->state));
      }
      out.lights.lights.push_back(*std::move(fitted));
      continue;
    }
    if (fitted.error().code != "no_readings") return Propagate(std::move(fitted));
    out.warnings.push_back({"no_readings", light.name, fitted.error().message});
    if (!nothing_read) nothing_read = std::move(fitted).error();
  }
  if (out.lights.lights.empty()) {
    if (nothing_read) return tl::unexpected(*std::move(nothing_read));
    return Refused("no_light", session.name, "the session describes no light");
  }
  return out;
}

}  // namespace lightcal
