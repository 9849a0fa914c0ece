// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/compare_emission.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "lightcal/core/units.h"
#include "lightcal/light/lamp_axes.h"

namespace lightcal {
namespace {

// Those of a surface or a table; anything else is round about its aim.
LampAxes AxesOf(const EngineLight& light) {
  const bool has_axes = light.kind == EngineLightKind::kFlat ||
                        light.kind == EngineLightKind::kTube ||
                        light.kind == EngineLightKind::kTable;
  return has_axes ? LampAxes{light.x, light.y, light.aim} : AxesOfAim(light.aim);
}

Vec3 Way(const LampAxes& axes, double off_rad, double round_rad) {
  const Vec3 aside = axes.c0 * std::cos(round_rad) + axes.c90 * std::sin(round_rad);
  return axes.aim * std::cos(off_rad) + aside * std::sin(off_rad);
}

bool IsFarAway(const EngineLight& light) {
  return light.kind == EngineLightKind::kSun || light.kind == EngineLightKind::kDome;
}

// From where a light's sides show: half its largest; 1 m where it has none.
double BallOf(const EngineLight& light) {
  const double side = std::max(light.width_m, light.height_m);
  return side > 0.0 ? side / 2.0 : 1.0;
}

// Even steps, and those of both cones, in radians.
std::vector<double> AnglesFor(const EngineLight& a, const EngineLight& b) {
  std::vector<double> angles;
  for (int i = 0; i <= 36; ++i) angles.push_back(RadiansFromDegrees(2.5 * i).value());
  for (const double deg : {100.0, 120.0, 140.0, 160.0, 180.0}) {
    angles.push_back(RadiansFromDegrees(deg).value());
  }
  for (const double outer : {a.outer_rad, b.outer_rad}) {
    for (const double part : {0.25, 0.5, 0.7, 0.85, 0.95, 1.05}) {
      angles.push_back(std::min(part * outer, std::numbers::pi));
    }
  }
  return angles;
}

const EngineLight* OnlyOne(const std::vector<EngineLight>& lights, const std::string& name) {
  if (std::ranges::count(lights, name, &EngineLight::name) != 1) return nullptr;
  return &*std::ranges::find(lights, name, &EngineLight::name);
}

double GivenTo(const EngineLight& light, const Vec3& way, double ball_m) {
  return LuxAt(light, light.position_m + way * ball_m, way * -1.0);
}

struct Direction {
  double off_rad = 0.0, round_rad = 0.0, given = 0.0, exported = 0.0;
};

EmissionOff Furthest(const EngineLight& light, const EngineLight& fresh, bool aimed) {
  const LampAxes fresh_axes = AxesOf(fresh);
  const LampAxes own_axes = aimed ? fresh_axes : AxesOf(light);
  const double ball_m = BallOf(fresh);
  constexpr int kSides = 16;
  std::vector<Direction> all;
  double peak = 0.0, given_sum = 0.0, exported_sum = 0.0;
  for (const double off : AnglesFor(light, fresh)) {
    for (int i = 0; i < (off > 0.0 ? kSides : 1); ++i) {
      const double round = 2.0 * std::numbers::pi * i / kSides;
      all.push_back({off, round, GivenTo(light, Way(own_axes, off, round), ball_m),
                     GivenTo(fresh, Way(fresh_axes, off, round), ball_m)});
      peak = std::max(peak, all.back().exported);
      given_sum += all.back().given;
      exported_sum += all.back().exported;
    }
  }
  // By what it gives on its axis, which the readings judge; where that is dark, by all directions.
  constexpr double kDark = 0.1;
  const Direction& axis = all.front();
  const bool lit = axis.exported > kDark * peak && axis.given > 0.0;
  const double scale = lit               ? axis.exported / axis.given
                       : given_sum > 0.0 ? exported_sum / given_sum
                                         : 0.0;
  EmissionOff worst{light.name, 0.0, 0.0, 0.0, 0.0};
  if (!(peak > 0.0)) return worst;
  for (const Direction& one : all) {
    const double given = scale * one.given / peak, exported = one.exported / peak;
    if (std::abs(given - exported) <= std::abs(worst.given - worst.exported)) continue;
    worst = {light.name, DegreesFromRadians(Radians(one.off_rad)),
             DegreesFromRadians(Radians(one.round_rad)), given, exported};
  }
  return worst;
}

}  // namespace

std::vector<EmissionOff> CompareEmission(const Session& session,
                                         const std::vector<EngineLight>& lights,
                                         const std::vector<EngineLight>& exported,
                                         double max_error) {
  std::vector<EmissionOff> off;
  for (const EngineLight& fresh : exported) {
    const LightDescription* description = FindLight(session, fresh.name);
    const EngineLight* light = OnlyOne(lights, fresh.name);
    if (description == nullptr || light == nullptr || OnlyOne(exported, fresh.name) == nullptr ||
        !light->placed || !fresh.placed || IsFarAway(*light) || IsFarAway(fresh)) {
      continue;
    }
    const EmissionOff one = Furthest(*light, fresh, description->aim.has_value());
    if (std::abs(one.given - one.exported) > max_error) off.push_back(one);
  }
  return off;
}

}  // namespace lightcal
