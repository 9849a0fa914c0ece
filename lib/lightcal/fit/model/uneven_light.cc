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

// How many of them share an error as large as `one`.
double Sharing(const std::vector<double>& errors, double one) {
  double out = 0.0;
  for (const double error : errors) out += std::min(1.0, error / one);
  return out;
}

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

// Of a gradient, along a direction that nobody states.
double Anywhere(const Vec3& gradient_sd) { return Length(gradient_sd) / std::sqrt(3.0); }

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

// By readings that say how far off its axis they were taken; which way round it nobody says.
std::vector<double> UnevenByAngles(const Observations& observations,
                                   const LightDescription& light) {
  std::vector<double> own;
  for (const Observation& o : observations.rows) {
    own.push_back(o.lit ? UnevenAside(light, Radians(o.off_axis_rad)) : 0.0);
  }
  if (std::ranges::none_of(own, [](double sd) { return sd > 0.0; })) return {};
  std::vector<double> out = own;
  for (double& sd : out) sd *= sd > 0.0 ? std::sqrt(Sharing(own, sd)) : 0.0;
  return out;
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

double UnevenAside(const LightDescription& light, Radians off_axis) {
  LightDescription named = light;
  if (!named.fixture) named.fixture = Fixture::kBulb;
  const std::optional<Vec3> sd = GradientOf(named);
  return sd ? Anywhere(*sd) * 2.0 * std::abs(std::sin(0.5 * off_axis.value())) : 0.0;
}

std::vector<double> UnevenTowards(const Observations& observations, const LightDescription& light) {
  const std::optional<UnevenLight> uneven = UnevenByPlaces(observations, light);
  if (!uneven || OfOneDirection(uneven->middle)) return UnevenByAngles(observations, light);
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
  const double anywhere = Anywhere(uneven->gradient_sd);
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
  std::vector<double> errors;
  for (const Observation& row : observations.rows) {
    errors.push_back(row.lit ? std::max(0.0, row.table_error) : 0.0);
  }
  std::vector<double> out(errors.size(), 0.0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!(errors[i] > 0.0)) continue;
    out[i] = kSigma * errors[i] * std::sqrt(Sharing(errors, errors[i]));
  }
  return out;
}

}  // namespace lightcal::fit
