// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/plan/plan_forward.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "lightcal/fit/model/uneven_light.h"
#include "lightcal/fit/plan/scene_of_session.h"
#include "lightcal/light/effect_cost.h"
#include "lightcal/light/effects/detector_size.h"
#include "lightcal/light/effects/haze.h"
#include "lightcal/light/effects/room_bounce.h"
#include "lightcal/light/gate.h"
#include "lightcal/light/room_bounce.h"

namespace lightcal::fit {
namespace {

EffectState StateOf(GateState state) {
  if (state == GateState::kOn) return EffectState::kOn;
  return state == GateState::kFitted ? EffectState::kFitted : EffectState::kOff;
}

// An influence of relative size sd at the farthest reading.
Consider Widening(const Scene& scene, const GatedEffect& effect, double sd) {
  const double power = effect.finding.distance_power;
  const std::string_view part = effect.finding.part.empty() ? effect.name : effect.finding.part;
  return {sd / std::pow(FarthestDistance(scene), power),
          power,
          std::string(part),
          effect.finding.own_lamp,
          effect.name == "ambient",
          effect.finding.of_pictures};
}

// Relative, 1 sigma. What is left off: a rectangular distribution of half width `bound`, unless
// more is known.
double WidensBy(const GatedEffect& effect) {
  const double bound = effect.finding.bound;
  if (effect.state == GateState::kOff) {
    if (!effect.ignored || !(bound > 0.0)) return 0.0;
    const double most = bound / std::numbers::sqrt3;
    return std::min(most, effect.finding.sd.value_or(most));
  }
  if (effect.finding.treatment != Treatment::kWidens) return 0.0;
  return effect.finding.sd.value_or(0.5 * bound);
}

EffectReport ReportOf(const GatedEffect& effect, const Scene& scene, const FitSettings& settings) {
  const double cost_ns =
      settings.time_effects ? MeasuredCost_ns(effect.name, scene) : effect.cost_ns;
  return {std::string(effect.name),
          StateOf(effect.state),
          effect.finding.bound,
          std::nullopt,
          cost_ns,
          effect.reason,
          std::string(effect.key)};
}

void ModelBounce(const Scene& scene, const Observations& observations, ForwardModel& model) {
  double mean = 0.0;
  bool even = true;
  auto pose = scene.poses.begin();
  for (const Observation& row : observations.rows) {
    double bounce = 0.0;
    if (row.lit) {
      if (!row.differenced) {
        const Bounce found = BounceAt(scene, *pose);
        bounce = found.Estimate();
        even = even && found.even;
      }
      mean += bounce / static_cast<double>(scene.poses.size());
      ++pose;
    }
    model.bounce_per_candela.push_back(bounce);
  }
  model.considered.push_back({BounceSigma(even) * mean, 2.0, "room_bounce"});
}

void ModelEffect(const Scene& scene, const LightDescription& light,
                 const Observations& observations, std::string_view name, ForwardModel& model) {
  if (name == "finite_source") model.shape = AxialShapeOf(light.kind, scene.size);
  if (name == "meter_tilt") model.tilt = true;
  if (name == "detector_size") model.head_radius_m = scene.head_radius->value();
  if (name == "haze") model.haze_per_m = *scene.time.haze_per_metre;
  if (name == "sphere_surface" && light.diameter) {
    model.surface_radius_m = 0.5 * light.diameter->value();
  }
  if (name == "room_bounce" && scene.room) ModelBounce(scene, observations, model);
}

void Apply(const Scene& scene, const LightDescription& light, const Observations& observations,
           const GatedEffect& effect, ForwardModel& model) {
  const Treatment treatment = effect.finding.treatment;
  const double bound = effect.finding.bound;
  if (effect.name == "distance_offset") {
    model.fit_offset = effect.state != GateState::kOff;
    // Who switches it off bends the model, not the readings.
    model.judge_misfit = model.fit_offset || effect.ignored;
  }
  // Behind cards alone no wall is left to fit, but a lamp of unknown kind may still be a panel.
  if (effect.name == "room_bounce" &&
      (effect.state == GateState::kFitted || bound == 0.0 || effects::AllBehindCards(scene))) {
    model.walls = scene.walls;
    model.over_ground = scene.over_ground;
  }
  // Who switches its size off by name has a point.
  if (effect.name == "finite_source" && (effect.state != GateState::kOff || effect.ignored)) {
    model.makes = scene.makes;
  }
  if (effect.name == "ambient" && effect.state == GateState::kOff) model.fit_ambient = false;
  const double sd = WidensBy(effect);
  if (sd > 0.0 && effect.name == "table_interpolation") {
    model.uneven = UnevenByTable(observations);
    model.uneven_part = effect.name;
  } else if (sd > 0.0) {
    model.considered.push_back(Widening(scene, effect, sd));
  }
  if (effect.state == GateState::kOff) return;
  if (treatment == Treatment::kModelled && bound > 0.0) {
    ModelEffect(scene, light, observations, effect.name, model);
  }
}

// What the size of a source placed off its axis does there, beside a point with the same lobe.
double SizeOffAxis(const Observation& row) {
  const Vec3& p = row.off_axis->at.position;
  const double r = Length(p);
  double lobe = 1.0;
  if (std::holds_alternative<TubeSource>(row.off_axis->source)) {
    lobe = std::hypot(p[1], p[2]) / r;
  } else if (std::holds_alternative<DiskSource>(row.off_axis->source) ||
             std::holds_alternative<RectSource>(row.off_axis->source)) {
    lobe = p[2] / r;
  } else {
    return 0.0;
  }
  return row.emission / lobe - 1.0;
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
    } else if (effect.name == "ambient" && row.raw_lx > 0.0) {
      part = estimate.theta[kAmbient] / row.raw_lx;
    } else if (effect.name == "finite_source") {
      part = row.off_axis ? SizeOffAxis(row) : AxialShapeFactor(model.shape, d) - 1.0;
    } else if (effect.name == "meter_tilt") {
      part = std::cos(row.tilt_rad) - 1.0;
    } else if (effect.name == "room_bounce" && !estimate.walls_per_candela.empty()) {
      part = estimate.walls_per_candela[i] * d * d;
    } else if (effect.name == "room_bounce" && !model.bounce_per_candela.empty()) {
      part = model.bounce_per_candela[i] * d * d;
    } else if (effect.name == "detector_size" && model.head_radius_m > 0.0) {
      part = effects::DetectorFactor(model.head_radius_m, d) - 1.0;
    } else if (effect.name == "haze" && model.haze_per_m > 0.0) {
      part = effects::HazeFactor(model.haze_per_m, d) - 1.0;
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

// The model and the report of what the gate decided.
void Follow(const LightDescription& light, const Observations& observations,
            const FitSettings& settings, ForwardPlan& plan) {
  const EstimatorChoice& choice = settings.estimator;
  plan.model = {};
  plan.model.choice = choice;
  plan.model.distance_law = HasDistanceLaw(light.kind);
  plan.model.offsets = plan.scene.offsets;
  plan.model.uneven = UnevenTowards(observations, light);
  plan.model.tilt = false;
  plan.effects.clear();
  for (GatedEffect& effect : plan.gated) {
    // Lamp-off readings are fitted however little they show.
    if (effect.name == "ambient" && plan.scene.ambient_ratio && effect.ignored) {
      effect.ignored = false;
      effect.state = GateState::kFitted;
      effect.reason = effect.finding.reason;
    }
    Apply(plan.scene, light, observations, effect, plan.model);
    if (!choice.exact_source) plan.model.shape = {};
    if (plan.model.surface_radius_m > 0.0 && plan.scene.offsets.size() == 2) {
      plan.model.offsets = {
          {1.0, plan.scene.offsets.front().mean_m, plan.scene.offsets.front().sd_m}};
    }
    if (effect.finding.applies) plan.effects.push_back(ReportOf(effect, plan.scene, settings));
  }
}

}  // namespace

Result<ForwardPlan> PlanForward(const Session& session, const LightDescription& light,
                                const Observations& observations, const FitSettings& settings) {
  ForwardPlan plan;
  plan.model.distance_law = HasDistanceLaw(light.kind);
  plan.model.tilt = false;
  plan.scene = SceneOfSession(session, light, observations, settings.estimator.bounce_patches);
  if (plan.scene.poses.empty()) return plan;  // the estimate refuses: no reading of the lamp
  Result<std::vector<GatedEffect>> effects =
      GateEffects(plan.scene, settings.tolerance_relative, settings.effects);
  if (!effects) return Propagate(std::move(effects));
  plan.gated = *std::move(effects);
  Follow(light, observations, settings, plan);
  return plan;
}

Result<LampInPictures> FindLampInPictures(const Session& session, const LightDescription& light,
                                          const ScenePicture& picture, double way_m,
                                          bool level_by_meter, const FitSettings& settings) {
  Scene scene;
  scene.kind = light.kind;
  scene.time = TimeOfLamp(session, light);
  scene.picture = picture;
  scene.no_walls = scene.dark = true;  // what they do to the wall is known otherwise
  scene.poses.resize(1);
  scene.poses.front().distance_m = way_m;
  const Result<std::vector<GatedEffect>> gated =
      GateEffects(scene, settings.tolerance_relative, settings.effects);
  if (!gated) return tl::unexpected(gated.error());
  LampInPictures out;
  for (const GatedEffect& effect : *gated) {
    const bool of_shutter = effect.name == "flicker" || effect.name == "rolling_shutter";
    const bool of_lamp =
        effect.name == "mains" || effect.name == "warm_up" || effect.name == "haze";
    if (!effect.finding.applies || !(of_lamp || (of_shutter && !level_by_meter))) continue;
    out.effects.push_back(ReportOf(effect, scene, settings));
    // No row of a reading's own holds the air here.
    const bool no_row = effect.finding.treatment == Treatment::kModelled;
    if (const double sd = no_row ? 0.5 * effect.finding.bound : WidensBy(effect); sd > 0.0) {
      out.parts.push_back({std::string(effect.name), sd * sd});
    }
  }
  return out;
}

Result<std::optional<ForwardPlan>> PlanAfterFit(const ForwardPlan& plan,
                                                const LightDescription& light,
                                                const Observations& observations,
                                                const FitSettings& settings,
                                                const LightEstimate& estimate) {
  const double offset = estimate.theta[kDistanceOffset];
  if (plan.gated.empty() || estimate.upper_limit || offset == 0.0) return std::nullopt;
  ForwardPlan next;
  next.scene = plan.scene;
  for (ScenePose& pose : next.scene.poses) {
    if (!pose.from_center) pose.distance_m = std::max(1e-6, pose.distance_m + offset);
  }
  Result<std::vector<GatedEffect>> effects =
      RegateEffects(plan.gated, next.scene, settings.tolerance_relative, settings.effects);
  if (!effects) return Propagate(std::move(effects));
  if (!OutgrewShare(plan.gated, *effects)) return std::nullopt;
  next.gated = *std::move(effects);
  for (std::size_t i = 0; i < next.gated.size(); ++i) {
    if (!plan.gated[i].ignored || next.gated[i].state == GateState::kOff) continue;
    next.gated[i].reason += "; off at first, and outgrown by the distance offset found";
  }
  // Poses stay as read: the model adds the offset itself.
  next.scene.poses = plan.scene.poses;
  Follow(light, observations, settings, next);
  return next;
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
