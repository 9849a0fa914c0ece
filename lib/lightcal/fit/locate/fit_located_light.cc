// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/fit_located_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lightcal/fit/locate/locate.h"
#include "lightcal/fit/model/asked_sampling.h"
#include "lightcal/fit/model/data_sheet.h"
#include "lightcal/fit/model/fill_light.h"
#include "lightcal/fit/model/meter_calibration.h"
#include "lightcal/fit/plan/plan_forward.h"

namespace lightcal::fit {
namespace {

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
void WidenByShape(const Observations& seen, ForwardModel& model) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Observation& o : seen.rows) {
    if (o.lit) nearest = std::min(nearest, o.distance_m);
  }
  const double off = 1.0 - AxialShapeFactor(model.shape, nearest);
  if (off > 0.0) model.considered.push_back({off * nearest * nearest, -2.0, "finite_source"});
}

// Of a lamp whose place is sought, the light from the walls is not fitted: its prior's mean shines
// and its spread widens the interval.
void HoldWalls(const Observations& seen, ForwardModel& model) {
  if (model.walls.empty()) return;
  double lit = 0.0;
  double sd = 0.0;
  model.bounce_per_candela.clear();
  for (const Observation& o : seen.rows) {
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

}  // namespace

Result<FittedLight> FitLocatedLight(const Session& session, const LightDescription& light,
                                    const Observations& observations, const FitSettings& settings,
                                    FittedLight out, FittedSession& session_out) {
  Warnings& warnings = session_out.warnings;
  Result<LampLocation> first = LocateLamp(observations, light, ForwardModel{});
  if (!first) return Propagate(std::move(first));
  LightDescription placed = light;
  placed.position_m = first->position_m;
  const Observations seen = PlaceObservations(observations, first->position_m);
  Result<ForwardPlan> plan = PlanForward(session, placed, seen, settings);
  if (!plan) return Propagate(std::move(plan));
  WidenByShape(seen, plan->model);
  HoldWalls(seen, plan->model);
  Result<LampLocation> location = LocateLamp(seen, light, plan->model, &*first);
  if (!location) return Propagate(std::move(location));
  if (auto known = CheckKnown(location->estimate, light.name); !known) {
    return Propagate(std::move(known));
  }
  session_out.Warn(std::move(location->estimate.warnings));
  AddCalibration(LargestCalibration(seen), location->estimate);
  if (SamplingOf(settings)) {
    session_out.notes.push_back(SayOfSampling(location->estimate, light.name));
  }
  FillParameters(location->estimate, true, out);
  out.distance_offset_m.reset();
  out.position_m = location->position_m;
  Vec3 u95{};
  for (std::size_t k = 0; k < 3; ++k) u95[k] = kZ95 * std::sqrt(location->covariance_m2[4 * k]);
  out.position_u95_m = u95;
  out.fit = location->estimate.diagnostics;
  out.residuals = location->estimate.residuals;
  out.effects = ReportEffects(*plan, seen, location->estimate);
  out.budget = BudgetOf(location->estimate.variance_parts);
  NameOffsetFound(out.effects);
  ReportCalibration(seen, out.effects);
  out.meter = MeterOf(session, light.name, seen);
  AddDerivedQuantities(light, out);
  CheckDataSheet(light, out.intensity_cd, warnings);
  return out;
}

}  // namespace lightcal::fit
