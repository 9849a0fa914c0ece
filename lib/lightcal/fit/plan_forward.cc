// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/plan_forward.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "lightcal/light/effects/detector_size.h"
#include "lightcal/light/gate.h"
#include "lightcal/light/room_bounce.h"

namespace lightcal::fit {
namespace {

template <class T>
void KeepLargest(std::optional<T>& kept, const std::optional<T>& next) {
  if (next && (!kept || *next > *kept)) kept = next;
}

// The worst of what the light's meters state.
void AddMeters(const Session& session, const LightDescription& light, Scene& scene) {
  for (const MeterDescription& meter : session.meters) {
    const bool used = std::any_of(
        session.readings.begin(), session.readings.end(), [&](const SessionReading& row) {
          return row.reading.light == light.name && row.reading.meter == meter.name;
        });
    if (!used) continue;
    KeepLargest(scene.spectral_f1, meter.spectral_f1);
    KeepLargest(scene.cosine_f2, meter.cosine_f2);
    KeepLargest(scene.head_radius, meter.head_radius);
  }
}

std::optional<double> AmbientRatio(const Observations& observations) {
  double off = 0.0;
  int count = 0;
  double dimmest = std::numeric_limits<double>::infinity();
  for (const Observation& row : observations.rows) {
    if (row.lit && row.raw_lx > 0.0) dimmest = std::min(dimmest, row.raw_lx);
    if (row.lit) continue;
    off += row.measured_lx;
    ++count;
  }
  if (count == 0 || !std::isfinite(dimmest)) return std::nullopt;
  return off / count / dimmest;
}

Scene SceneOf(const Session& session, const LightDescription& light,
              const Observations& observations, int patches) {
  Scene scene;
  scene.kind = light.kind;
  scene.size = {light.diameter, light.width, light.height, light.length, light.radius};
  scene.position_m = light.position_m;
  scene.aim = light.aim;
  scene.inner = light.inner;
  scene.outer = light.outer;
  scene.beam = light.beam;
  for (const Observation& row : observations.rows) {
    if (!row.lit) continue;
    scene.poses.push_back(
        {row.distance_m, row.tilt_rad, row.measured_from_center, row.differenced, row.position_m});
  }
  scene.distances = CountDistinctDistances(observations.rows);
  scene.ambient_ratio = AmbientRatio(observations);
  if (session.room) scene.room = RoomBox{session.room->size_m, session.room->reflectance, patches};
  AddMeters(session, light, scene);
  return scene;
}

EffectState StateOf(GateState state) {
  if (state == GateState::kOn) return EffectState::kOn;
  return state == GateState::kFitted ? EffectState::kFitted : EffectState::kOff;
}

// An influence of relative size sd at the farthest reading.
Consider Widening(const Scene& scene, const GatedEffect& effect, double sd) {
  const double power = effect.finding.distance_power;
  return {sd / std::pow(FarthestDistance(scene), power), power};
}

void ModelBounce(const Scene& scene, const Observations& observations, ForwardModel& model) {
  double mean = 0.0;
  auto pose = scene.poses.begin();
  for (const Observation& row : observations.rows) {
    double bounce = 0.0;
    if (row.lit) {
      if (!row.differenced) bounce = BounceAt(scene, *pose).Estimate();
      mean += bounce / static_cast<double>(scene.poses.size());
      ++pose;
    }
    model.bounce_per_candela.push_back(bounce);
  }
  model.considered.push_back({kBounceSigma * mean, 2.0});
}

void ModelEffect(const Scene& scene, const LightDescription& light,
                 const Observations& observations, std::string_view name, ForwardModel& model) {
  if (name == "finite_source") model.shape = AxialShapeOf(light.kind, scene.size);
  if (name == "meter_tilt") model.tilt = true;
  if (name == "detector_size") model.head_radius_m = scene.head_radius->value();
  if (name == "sphere_surface" && light.diameter) {
    model.surface_radius_m = 0.5 * light.diameter->value();
  }
  if (name == "room_bounce" && scene.room) ModelBounce(scene, observations, model);
}

void Apply(const Scene& scene, const LightDescription& light, const Observations& observations,
           const GatedEffect& effect, ForwardModel& model) {
  const Treatment treatment = effect.finding.treatment;
  const double bound = effect.finding.bound;
  if (effect.name == "distance_offset") model.fit_offset = effect.state != GateState::kOff;
  if (effect.name == "ambient" && effect.state == GateState::kOff) {
    model.fit_ambient = treatment == Treatment::kUnknown && !effect.forced;
  }
  if (effect.state == GateState::kOff) {
    // A rectangular distribution of half width `bound`.
    if (effect.ignored && bound > 0.0) {
      model.considered.push_back(Widening(scene, effect, bound / std::numbers::sqrt3));
    }
    return;
  }
  if (treatment == Treatment::kWidens) {
    model.considered.push_back(Widening(scene, effect, 0.5 * bound));
  }
  if (treatment == Treatment::kModelled && bound > 0.0) {
    ModelEffect(scene, light, observations, effect.name, model);
  }
}

// What an effect did at the reading where it did most.
std::optional<double> ContributionOf(const EffectReport& effect, const ForwardModel& model,
                                     const Observations& observations,
                                     const LightEstimate& estimate) {
  if (effect.state == EffectState::kOff || estimate.upper_limit) return std::nullopt;
  double most = 0.0;
  bool known = false;
  for (std::size_t i = 0; i < observations.rows.size(); ++i) {
    const Observation& row = observations.rows[i];
    if (!row.lit) continue;
    const double d = row.distance_m;
    double part = 0.0;
    if (effect.name == "distance_offset") {
      const double ratio = d / (d + estimate.theta[kDistanceOffset]);
      part = ratio * ratio - 1.0;
    } else if (effect.name == "ambient") {
      part = estimate.theta[kAmbient] / row.raw_lx;
    } else if (effect.name == "finite_source") {
      part = AxialShapeFactor(model.shape, d) - 1.0;
    } else if (effect.name == "meter_tilt") {
      part = std::cos(row.tilt_rad) - 1.0;
    } else if (effect.name == "room_bounce" && !model.bounce_per_candela.empty()) {
      part = model.bounce_per_candela[i] * d * d;
    } else if (effect.name == "detector_size" && model.head_radius_m > 0.0) {
      part = effects::DetectorFactor(model.head_radius_m, d) - 1.0;
    } else if (effect.name == "sphere_surface" && model.surface_radius_m > 0.0) {
      part = d * d / ((d + model.surface_radius_m) * (d + model.surface_radius_m)) - 1.0;
    } else {
      continue;
    }
    known = true;
    if (std::abs(part) > std::abs(most)) most = part;
  }
  if (!known || !std::isfinite(most)) return std::nullopt;
  return most;
}

}  // namespace

Result<ForwardPlan> PlanForward(const Session& session, const LightDescription& light,
                                const Observations& observations, const FitSettings& settings) {
  ForwardPlan plan;
  plan.model.distance_law = HasDistanceLaw(light.kind);
  plan.model.tilt = false;
  plan.model.choice = settings.estimator;
  const Scene scene = SceneOf(session, light, observations, settings.estimator.bounce_patches);
  if (scene.poses.empty()) return plan;  // the estimate refuses: no reading of the lamp
  Result<std::vector<GatedEffect>> effects =
      GateEffects(scene, settings.tolerance_relative, settings.effects);
  if (!effects) return Propagate(std::move(effects));
  for (GatedEffect& effect : *effects) {
    // Lamp-off readings are fitted however little they show.
    if (effect.name == "ambient" && scene.ambient_ratio && effect.ignored) {
      effect.ignored = false;
      effect.state = GateState::kFitted;
      effect.reason = effect.finding.reason;
    }
    Apply(scene, light, observations, effect, plan.model);
    if (!settings.estimator.exact_source) plan.model.shape = {};
    plan.effects.push_back({std::string(effect.name), StateOf(effect.state), effect.finding.bound,
                            std::nullopt, effect.cost_ns, effect.reason});
  }
  return plan;
}

std::vector<EffectReport> ReportEffects(const ForwardPlan& plan, const Observations& observations,
                                        const LightEstimate& estimate) {
  std::vector<EffectReport> effects = plan.effects;
  for (EffectReport& effect : effects) {
    effect.contribution = ContributionOf(effect, plan.model, observations, estimate);
  }
  return effects;
}

}  // namespace lightcal::fit
