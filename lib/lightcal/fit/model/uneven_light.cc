// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/uneven_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lightcal/light/effects/table_interpolation.h"

namespace lightcal::fit {
namespace {

// A bulb's base keeps light from one end, and it stands or hangs on it (Z is up): traced ones go as
// 1 + (-.1 to .5) cos, .26 in all, one in five screwed in sideways; ENERGY STAR's omnidirectional
// lamps (V2.1, 9.4) stay within 35 % of their mean.
constexpr Vec3 kOfBulb = {0.09, 0.09, 0.22};
// What shines to one side falls as the cosine does.
constexpr Vec3 kToOneSide = {0.8, 0.8, 0.8};
// Unit vectors nearer together than this are one direction.
constexpr double kOneDirection = 0.25;

std::vector<std::optional<Vec3>> DirectionsOf(const Observations& observations, const Vec3& lamp) {
  std::vector<std::optional<Vec3>> out(observations.rows.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Observation& o = observations.rows[i];
    if (!o.lit || !o.position_m) continue;
    const Vec3 way = *o.position_m - lamp;
    if (Length(way) > 0.0) out[i] = way * (1.0 / Length(way));
  }
  return out;
}

// Readings of one direction.
struct SharedDirection {
  Vec3 towards{};
  int readings = 0;
};

// The mean direction to the meters whose place is known.
std::optional<Vec3> MiddleOf(const Observations& observations, const Vec3& lamp) {
  Vec3 sum{};
  int count = 0;
  for (const auto& one : DirectionsOf(observations, lamp)) {
    if (!one) continue;
    sum = sum + *one;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum * (1.0 / count);
}

// By readings whose places are known.
std::optional<UnevenLight> UnevenByPlaces(const Observations& observations,
                                          const LightDescription& light) {
  const std::optional<Vec3> sd = GradientOf(light);
  if (!sd || !light.position_m) return std::nullopt;
  const std::optional<Vec3> middle = MiddleOf(observations, *light.position_m);
  return middle ? std::optional(UnevenLight{*sd, *middle}) : std::nullopt;
}

// The mean of unit vectors that are one is as long as they are.
bool OfOneDirection(const Vec3& middle) {
  return Length(middle) > 1.0 - 0.5 * kOneDirection * kOneDirection;
}

}  // namespace

std::optional<Vec3> GradientOf(const LightDescription& light) {
  if (light.kind != LightKind::kPoint || !light.fixture) return std::nullopt;
  switch (*light.fixture) {
    case Fixture::kBulb:
    case Fixture::kSoftbox:
      return kOfBulb;
    default:
      return kToOneSide;
  }
}

std::optional<UnevenLight> UnevenOf(const Observations& observations,
                                    const LightDescription& light) {
  LightDescription named = light;
  if (light.kind == LightKind::kPoint && !light.fixture) {
    const bool all_round = TakenToShineEvenly(observations, light);
    named.fixture = all_round ? Fixture::kBulb : Fixture::kReflector;
  }
  if (auto placed = UnevenByPlaces(observations, named)) return placed;
  const std::optional<Vec3> sd = GradientOf(named);
  const bool read = std::ranges::any_of(observations.rows, &Observation::lit);
  if (!sd || !read) return std::nullopt;
  const double length = light.aim ? Length(*light.aim) : 0.0;
  return UnevenLight{*sd, length > 0.0 ? *light.aim * (1.0 / length) : Vec3{}};
}

bool TakenToShineEvenly(const Observations& observations, const LightDescription& light) {
  if (light.kind != LightKind::kPoint || light.fixture || !light.position_m) return false;
  const std::optional<Vec3> middle = MiddleOf(observations, *light.position_m);
  return middle && !OfOneDirection(*middle);
}

std::string SayThatItShinesEvenly(const std::string& light) {
  return light +
         ": is taken for a point that shines alike towards every meter; a bulb's base takes light "
         "from some: fixture = \"bulb\" lets the intervals hold that too";
}

std::vector<double> UnevenTowards(const Observations& observations, const LightDescription& light) {
  const std::optional<UnevenLight> uneven = UnevenByPlaces(observations, light);
  if (!uneven || OfOneDirection(uneven->middle)) return {};
  const auto directions = DirectionsOf(observations, *light.position_m);
  // Each reading is of the first direction that it is near to: a sphere has some hundred of them.
  std::vector<SharedDirection> shared;
  std::vector<std::size_t> which(directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (!directions[i]) continue;
    const auto near = std::ranges::find_if(shared, [&](const SharedDirection& one) {
      return Length(one.towards - *directions[i]) <= kOneDirection;
    });
    which[i] = static_cast<std::size_t>(near - shared.begin());
    if (near == shared.end()) shared.push_back({*directions[i], 0});
    ++shared[which[i]].readings;
  }
  const double anywhere = Length(uneven->gradient_sd) / std::sqrt(3.0);
  std::vector<double> out(directions.size(), anywhere);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!directions[i]) continue;
    const double sharing = shared[which[i]].readings;
    out[i] = SdTowards(*uneven, *directions[i]) * std::sqrt(sharing);
  }
  return out;
}

std::vector<double> UnevenByTable(const Observations& observations) {
  // Half the bound.
  constexpr double kSigma = 0.5 * effects::kInterpolationMargin;
  const std::vector<Observation>& rows = observations.rows;
  std::vector<double> out(rows.size(), 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double error = rows[i].lit ? rows[i].table_error : 0.0;
    if (!(error > 0.0)) continue;
    double sharing = 0.0;
    for (const Observation& row : rows) {
      if (row.lit) sharing += std::min(1.0, row.table_error / error);
    }
    out[i] = kSigma * error * std::sqrt(sharing);
  }
  return out;
}

}  // namespace lightcal::fit
