// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/fit_located_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/locate/locate.h"
#include "lightcal/fit/locate/located_lamp.h"
#include "lightcal/fit/model/asked_sampling.h"
#include "lightcal/fit/model/data_sheet.h"
#include "lightcal/fit/model/fill_light.h"
#include "lightcal/fit/model/meter_calibration.h"
#include "lightcal/fit/model/off_axis.h"
#include "lightcal/fit/model/uneven_light.h"
#include "lightcal/fit/plan/plan_forward.h"
#include "lightcal/light/effects/cosine_response.h"

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

bool IsFlat(const LightDescription& light) {
  return light.kind == LightKind::kDisk || light.kind == LightKind::kRect;
}

// How a rect that is no square is turned about its aim is known by its axis alone. Without one,
// what a meter beside the aim sees of its size may be as far off as on it.
void WidenByTurn(const LightDescription& light, const Observations& seen, ForwardModel& model) {
  const bool turned = light.kind == LightKind::kRect && !light.axis && light.width &&
                      light.height && light.width->value() != light.height->value();
  if (!turned) return;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Observation& o : seen.rows) {
    if (o.lit) nearest = std::min(nearest, o.distance_m);
  }
  const double off = 1.0 - AxialShapeFactor(model.shape, nearest);
  if (off > 0.0) model.considered.push_back({off * nearest * nearest, -2.0, "finite_source"});
}

// A head's error grows with the tilt, so between readings it moves the place, which no sigma that
// they have in common holds: known or not, it widens.
void WidenByCosine(const Observations& seen, ForwardPlan& plan) {
  constexpr std::string_view kName = "cosine_response";
  const auto effect = std::ranges::find(plan.gated, kName, &GatedEffect::name);
  if (effect == plan.gated.end() || !effect->finding.applies) return;
  if (effect->state == GateState::kOff && !effect->ignored) return;  // switched off by name
  std::erase_if(plan.model.considered, [&](const Consider& one) { return one.name == kName; });
  std::set<int> instruments;
  for (const Observation& o : seen.rows) {
    if (o.lit && !o.data_sheet) instruments.insert(o.instrument);
  }
  const double f2 = plan.scene.cosine_f2.value_or(effects::kCosineF2Default);
  for (EffectReport& report : plan.effects) {
    if (report.name != kName || report.state == EffectState::kOff) continue;
    report.reason = "it widens the place and the intensity, by an f2 of " + PercentText(f2) +
                    (plan.scene.cosine_f2 ? ", as stated" : ", class B's: no cosine_f2 given");
  }
  for (const int instrument : instruments) {
    plan.model.considered.push_back({.relative = effects::SlantError(f2, 0.0),
                                     .name = std::string(kName),
                                     .slant_of = instrument});
  }
}

// Whoever seeks a point's place takes it that it shines alike towards every meter: it lights its
// room as a bulb does, unless its fixture says more.
LightDescription ShiningEvenly(LightDescription light) {
  if (light.kind == LightKind::kPoint && !light.fixture) light.fixture = Fixture::kBulb;
  return light;
}

// The lamp again, by its data sheet too, where what the readings say of its intensity agrees. Where
// it stands follows: to a few meters, a lamp farther off and brighter is much the same.
void HearSheet(const SheetIntensity& sheet, const Observations& seen, const LightDescription& light,
               ForwardModel model, LampLocation& location) {
  constexpr double kHeld = 0.95;
  const LightEstimate& read = location.estimate;
  const double ln_cd = read.theta[kLnIntensity], sd = SdOf(read.covariance, kLnIntensity);
  if (!Agrees(sheet, ln_cd, sd)) return;
  model.sheet = sheet;
  Result<LampLocation> told = LocateLamp(seen, light, model, &location);
  if (!told) return;
  told->estimate.ln_by_readings = LnInterval{ln_cd - kZ95 * sd, ln_cd + kZ95 * sd};
  told->estimate.sheet_held = kHeld;
  location = *std::move(told);
}

// What a wall, a ceiling or a floor near the lamp sends back starts about where the lamp stands,
// and no longer falls as the light of walls all round does: in traced rooms a bulb 25 cm from one
// was found 20 cm off, at 50 cm as closely as its interval says. Only what a card leaves tells the
// two apart.
void TellOfNearWalls(const Session& session, const LightDescription& light,
                     const Observations& seen, const Vec3& place_m, FittedSession& out) {
  constexpr double kNear_m = 0.5;
  const bool to_one_side = light.fixture && light.fixture != Fixture::kBulb;
  const bool all_round =
      light.kind == LightKind::kSphere || (light.kind == LightKind::kPoint && !to_one_side);
  const bool open = std::ranges::any_of(
      seen.rows, [](const Observation& o) { return o.lit && o.sees_walls && !o.differenced; });
  if (!all_round || !open) return;
  const std::string cure = "read each place once more behind a shadow card, or give its position_m";
  if (!session.room) {
    out.notes.push_back(light.name +
                        ": its place holds for a lamp half a metre or more from every "
                        "wall; nearer to one its light and the wall's are hard to tell apart: " +
                        cure);
    return;
  }
  const Vec3& size = session.room->size_m;
  const double nearest =
      std::min({0.5 * size[0] - std::abs(place_m[0]), 0.5 * size[1] - std::abs(place_m[1]),
                place_m[2], size[2] - place_m[2]});
  if (nearest >= kNear_m) return;
  out.warnings.push_back(
      {"near_wall", light.name,
       "the lamp seems to stand " + RoundedText(std::max(0.0, nearest), 2) +
           " m from a wall, the ceiling or the floor of its room: what that sends back starts "
           "about "
           "there, and may put the place several tenths of a metre off, beyond its interval: " +
           cure});
}

}  // namespace

Result<FittedLight> FitLocatedLight(const Session& session, const LightDescription& light,
                                    const Observations& observations, const FitSettings& settings,
                                    FittedLight out, FittedSession& session_out) {
  Warnings& warnings = session_out.warnings;
  // What the walls may add is asked of a lamp at 1 m until its place is known.
  const LightDescription even = ShiningEvenly(light);
  Result<ForwardPlan> rough = PlanForward(session, even, observations, settings);
  if (!rough) return Propagate(std::move(rough));
  ForwardModel rough_model;
  rough_model.walls = rough->model.walls;
  rough_model.over_ground = rough->model.over_ground;
  rough_model.shape = rough->model.shape;
  rough_model.gradient_sd = GradientOf(light);
  Result<LampLocation> first = LocateLamp(observations, light, rough_model);
  if (!first) return Propagate(std::move(first));
  LightDescription placed = even;
  placed.position_m = first->position_m;
  Observations seen = PlaceObservations(observations, first->position_m);
  if (const auto source = PlacedSourceOf(placed); source && IsFlat(light)) {
    PoseBefore(*source, light.kind, seen);
  }
  Result<ForwardPlan> plan = PlanForward(session, placed, seen, settings);
  if (!plan) return Propagate(std::move(plan));
  WidenByTurn(light, seen, plan->model);
  WidenByCosine(seen, *plan);
  plan->model.gradient_sd = rough_model.gradient_sd;
  Result<LampLocation> location = LocateLamp(seen, light, plan->model, &*first);
  if (!location) return Propagate(std::move(location));
  if (const auto sheet = SheetBeside(session, seen, even)) {
    HearSheet(*sheet, seen, light, plan->model, *location);
  }
  if (auto known = CheckKnown(location->estimate, light.name); !known) {
    return Propagate(std::move(known));
  }
  session_out.Warn(std::move(location->estimate.warnings));
  AddCalibration(SharedCalibration(seen), location->estimate);
  AddCalibration(SharedCalibration(seen), location->known);
  if (SamplingOf(settings)) {
    session_out.notes.push_back(SayOfSampling(location->estimate, light.name));
  }
  FillParameters(location->estimate, true, out);
  out.distance_offset_m.reset();
  out.position_m = location->position_m;
  Vec3 u95{};
  for (std::size_t k = 0; k < 3; ++k) u95[k] = kZ95 * std::sqrt(location->covariance_m2[4 * k]);
  out.position_u95_m = u95;
  out.located = location->known;
  out.fit = location->estimate.diagnostics;
  out.residuals = location->estimate.residuals;
  out.effects = ReportEffects(*plan, seen, location->estimate);
  out.budget = BudgetOf(location->estimate.variance_parts);
  NameOffsetFound(out.effects);
  TellOfNearWalls(session, light, seen, location->position_m, session_out);
  if (light.kind == LightKind::kPoint && !light.fixture) {
    session_out.notes.push_back(SayThatItShinesEvenly(light.name));
  }
  ReportCalibration(seen, out.effects);
  out.meter = MeterOf(session, light.name, seen);
  AddDerivedQuantities(light, out);
  TellFlux(location->estimate, light, out);
  CheckDataSheet(light, ByReadings(location->estimate, out), warnings);
  return out;
}

}  // namespace lightcal::fit
