// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/states/settable_lamp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

#include "lightcal/core/parallel.h"
#include "lightcal/fit/states/ln_of.h"

namespace lightcal {
namespace {

// Points of a grid along each control, by how many controls there are.
constexpr std::array<int, 4> kGridPoints = {0, 17, 8, 4};
constexpr double kDimmerStep = 0.1, kKelvinStep = 1.0, kOtherSteps = 1000.0;
constexpr double kFullDimmer = 100.0;

std::optional<LightPoint> PointFrom(const FittedLight& light, const std::string& session,
                                    const FittedColor& color,
                                    const std::optional<Uncertain>& intensity_cd,
                                    const std::optional<Uncertain>& illuminance_lx) {
  if (!color.xy) return std::nullopt;
  LightPoint point;
  point.xy = *color.xy;
  point.color_meter = color.meter;
  if (color.cct_K) point.sd.ln_mired = fit::SdOfLn(*color.cct_K);
  if (color.duv) point.sd.duv = color.duv->u95 / kZ95;
  point.own = {std::min(kRepeatsLnMired, point.sd.ln_mired), std::min(kRepeatsDuv, point.sd.duv)};
  const Uncertain* level = nullptr;
  if (intensity_cd) {
    level = &*intensity_cd;
    point.kind = LevelKind::kIntensity;
  } else if (illuminance_lx) {
    level = &*illuminance_lx;
    point.kind = LevelKind::kIlluminance;
  }
  if (level != nullptr && level->value > 0.0) {
    point.level = level->value;
    point.sd.ln_level = fit::SdOfLn(*level);
    point.level_meter = light.meter;
    // Nobody's name is one meter's among the lights of one fit.
    if (light.meter && light.meter->name.empty()) point.level_meter->name = session + "/";
  } else {
    point.kind = LevelKind::kNone;
  }
  return point;
}

Xyz XyzOfPoint(const LightPoint& point) {
  const Xyz unit = XyzFromXyAtUnitY(point.xy);
  return {unit.X * point.level, point.level, unit.Z * point.level};
}

}  // namespace

double UvBetween(Xy a, Xy b) {
  const Uv1976 ua = Uv1976FromXy(a);
  const Uv1976 ub = Uv1976FromXy(b);
  return std::hypot(ua.u - ub.u, ua.v - ub.v);
}

LightPoint SumOf(const Settings& settings) {
  if (settings.size() == 1) return settings.front().point;
  LightPoint sum;
  Xyz xyz;
  for (const LampSetting& one : settings) {
    const Xyz part = XyzOfPoint(one.point);
    xyz = {xyz.X + part.X, xyz.Y + part.Y, xyz.Z + part.Z};
  }
  sum.xy = xyz.Y > 0.0 ? XyFromXyz(xyz) : settings.front().point.xy;
  sum.kind = settings.front().point.kind;
  sum.level = xyz.Y;
  return sum;
}

std::optional<double> StopsOver(const LightPoint& point, const LightPoint& target) {
  if (point.kind == LevelKind::kNone || point.kind != target.kind || !(point.level > 0.0)) {
    return std::nullopt;
  }
  return std::log2(point.level / target.level);
}

std::optional<LightPoint> PointOf(const FittedLight& light, const std::string& session) {
  if (!light.states.empty()) {
    if (const auto there = AnswerState(light, light.state)) return PointOf(light, session, *there);
  }
  return PointFrom(light, session, light.color, light.intensity_cd, light.illuminance_lx);
}

std::optional<LightPoint> PointOf(const FittedLight& light, const std::string& session,
                                  const StateAnswer& there) {
  auto point = PointFrom(light, session, there.color, there.intensity_cd, there.illuminance_lx);
  if (!point) return std::nullopt;
  point->own = {there.own.ln_mired, there.own.duv, there.own.ln_light};
  point->lamp = session + "/" + light.name;
  point->state = there.state;
  // A state is the reference times what its own readings are of the reference's: how these repeat
  // is in both factors, and in their product not at all.
  const std::optional<Uncertain>& reference =
      point->kind == LevelKind::kIntensity ? light.intensity_cd : light.illuminance_lx;
  if (point->kind != LevelKind::kNone && reference) {
    const double repeats = light.states.front().repeatability;
    const double sd = fit::SdOfLn(*reference);
    point->sd.ln_level =
        std::hypot(point->own.ln_level, std::sqrt(std::max(0.0, sd * sd - repeats * repeats)));
  }
  return point;
}

LampSettings::LampSettings(const SettableLamp& lamp) : lamp_(lamp) {
  if (lamp.light == nullptr) {
    const FixtureState full = {{std::string(kDimmerControl), kFullDimmer}};
    if (auto one = At(full)) read_.push_back(*std::move(one));
    candidates_ = read_;
    AddGrid(full);
    return;
  }
  answers_ = std::make_unique<StateAnswers>(*lamp.light);
  for (const MeasuredState& state : lamp.light->states) {
    if (auto one = At(state.state)) read_.push_back(*std::move(one));
  }
  candidates_ = read_;
  std::vector<FixtureState> seen;
  for (const LampSetting& one : read_) {
    const bool known = std::ranges::any_of(
        seen, [&](const FixtureState& state) { return SameWords(state, one.state); });
    if (known) continue;
    seen.push_back(one.state);
    AddGrid(one.state);
  }
}

std::optional<LampSetting> LampSettings::At(const FixtureState& state) const {
  if (lamp_.light == nullptr) {
    LampSetting setting;
    setting.state = state;
    const double part = NumberOfControl(state, kDimmerControl).value_or(kFullDimmer) / kFullDimmer;
    setting.point = lamp_.fixed;
    setting.point.level *= part;
    setting.relative = part;
    if (part < 1.0) setting.basis = StateBasis::kBetween;
    return setting;
  }
  return AnsweredBy(*answers_, state);
}

std::optional<LampSetting> LampSettings::AnsweredBy(StateAnswers& answers,
                                                    const FixtureState& state) const {
  const auto answer = answers.At(state);
  if (!answer) return std::nullopt;
  auto point = PointOf(*lamp_.light, lamp_.session, *answer);
  if (!point) return std::nullopt;
  LampSetting setting;
  setting.state = state;
  setting.basis = answer->basis;
  setting.point = *std::move(point);
  setting.relative = answer->relative.value;
  return setting;
}

std::vector<LampSettings::Axis> LampSettings::AxesAt(const FixtureState& state) const {
  std::vector<Axis> axes;
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (state[i].IsWord()) continue;
    Axis axis{i, std::numeric_limits<double>::infinity(), 0.0, 0.0};
    axis.most = -axis.least;
    if (lamp_.light == nullptr) {
      axis.least = 0.0;
      axis.most = kFullDimmer;
    } else {
      for (const MeasuredState& one : lamp_.light->states) {
        if (!SameWords(state, one.state)) continue;
        const double there = NumberOfControl(one.state, state[i].name).value_or(0.0);
        axis.least = std::min(axis.least, there);
        axis.most = std::max(axis.most, there);
      }
    }
    if (!(axis.most > axis.least)) continue;
    axis.step = state[i].name == kDimmerControl ? kDimmerStep
                : state[i].name == kCctControl  ? kKelvinStep
                                                : (axis.most - axis.least) / kOtherSteps;
    axes.push_back(axis);
  }
  return axes;
}

void LampSettings::AddGrid(const FixtureState& like) {
  const std::vector<Axis> axes = AxesAt(like);
  if (axes.empty() || axes.size() >= kGridPoints.size()) return;
  const int points = kGridPoints[axes.size()];
  std::vector<FixtureState> grid;
  for (std::vector<int> at(axes.size(), 0);;) {
    FixtureState state = like;
    for (std::size_t a = 0; a < axes.size(); ++a) {
      const double t = static_cast<double>(at[a]) / (points - 1);
      state[axes[a].control].number = axes[a].least + t * (axes[a].most - axes[a].least);
    }
    grid.push_back(std::move(state));
    std::size_t a = 0;
    while (a < at.size() && ++at[a] == points) at[a++] = 0;
    if (a == at.size()) break;
  }
  std::vector<std::optional<LampSetting>> found(grid.size());
  if (answers_ == nullptr) {
    std::ranges::transform(grid, found.begin(), [&](const FixtureState& one) { return At(one); });
  } else {
    // Each thread finds the curves once.
    const std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
    ParallelFor(static_cast<int>(threads), [&](int i) {
      StateAnswers answers(*lamp_.light);
      for (auto k = static_cast<std::size_t>(i); k < grid.size(); k += threads) {
        found[k] = AnsweredBy(answers, grid[k]);
      }
    });
  }
  for (auto& one : found) {
    if (one) candidates_.push_back(*std::move(one));
  }
}

}  // namespace lightcal
