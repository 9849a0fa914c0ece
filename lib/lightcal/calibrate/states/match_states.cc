// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/states/match_states.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <utility>

#include "lightcal/calibrate/states/settable_lamp.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/statistics.h"

namespace lightcal {
namespace {

constexpr double kUnnoticedUv = 0.0005;
constexpr double kUnnoticedStops = 0.05;
constexpr int kHalvings = 8;
constexpr int kMostMoves = 40;
constexpr double kLeastCostGain = 2e-3;  // of a cost: 1e-6 in u'v', 0.002 stops
constexpr std::uint64_t kStateMatchSeed = 20260123;
constexpr double kFar = 1e9;

using Lamps = std::vector<const LampSettings*>;
using Settings = std::vector<LampSetting>;

Xyz XyzOfPoint(const LightPoint& point) {
  const Xyz unit = XyzFromXyAtUnitY(point.xy);
  return {unit.X * point.level, point.level, unit.Z * point.level};
}

double UvBetween(Xy a, Xy b) {
  const Uv1976 ua = Uv1976FromXy(a);
  const Uv1976 ub = Uv1976FromXy(b);
  return std::hypot(ua.u - ub.u, ua.v - ub.v);
}

// All lamps together; of one without a level its colour.
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

// ---- the search ----

// What a setting costs; kFar and more where it is none.
using Cost = std::function<double(const LightPoint&)>;

Cost ColorCost(const LightPoint& target) {
  return
      [&target](const LightPoint& point) { return UvBetween(point.xy, target.xy) / kUnnoticedUv; };
}

// Light, within what nobody tells apart of the nearest colour.
Cost LightCost(const LightPoint& target, double nearest_uv) {
  return [&target, nearest_uv](const LightPoint& point) {
    const double beyond = std::max(0.0, UvBetween(point.xy, target.xy) - nearest_uv - kUnnoticedUv);
    const auto stops = StopsOver(point, target);
    const double light = stops               ? std::abs(*stops)
                         : point.level > 0.0 ? 100.0 - std::log2(point.level)
                                             : 1000.0;
    return light + 0.01 * UvBetween(point.xy, target.xy) / kUnnoticedUv +
           1e4 * beyond / kUnnoticedUv;
  };
}

std::optional<Settings> SettingsAt(const Lamps& lamps, const std::vector<FixtureState>& states) {
  Settings settings;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    auto one = lamps[i]->At(states[i]);
    if (!one) return std::nullopt;
    settings.push_back(*std::move(one));
  }
  return settings;
}

struct Found {
  Settings settings;
  double cost = kFar;
};

// The best of each lamp's candidates with each of the other's.
Found BestCandidate(const Lamps& lamps, const Cost& cost) {
  Found best;
  const auto add = [&](Settings settings) {
    const double value = cost(SumOf(settings));
    if (best.settings.empty() || value < best.cost) best = {std::move(settings), value};
  };
  for (const LampSetting& first : lamps.front()->candidates()) {
    if (lamps.size() == 1) {
      add({first});
      continue;
    }
    for (const LampSetting& second : lamps.back()->candidates()) add({first, second});
  }
  return best;
}

// Steps along each control by itself, from a sixteenth of its range, halved where none helps.
Found Descend(const Lamps& lamps, Found from, const Cost& cost) {
  double step = 0.0625;
  int moves = 0;
  for (int halvings = 0; halvings < kHalvings;) {
    bool moved = false;
    for (std::size_t i = 0; i < lamps.size(); ++i) {
      for (const auto& axis : lamps[i]->AxesAt(from.settings[i].state)) {
        for (const double sign : {1.0, -1.0}) {
          FixtureState state = from.settings[i].state;
          double& number = state[axis.control].number;
          number =
              std::clamp(number + sign * step * (axis.most - axis.least), axis.least, axis.most);
          auto one = lamps[i]->At(state);
          if (!one) continue;
          Settings settings = from.settings;
          settings[i] = *std::move(one);
          const double value = cost(SumOf(settings));
          if (!(value < from.cost - kLeastCostGain)) continue;
          from = {std::move(settings), value};
          moved = true;
          break;
        }
      }
    }
    if (moved && ++moves < kMostMoves) continue;
    step /= 2.0;
    ++halvings;
  }
  return from;
}

Found LeastOf(const Lamps& lamps, const std::vector<Found>& starts, const Cost& cost) {
  Found best;
  for (const Found& start : starts) {
    Found found = Descend(lamps, {start.settings, cost(SumOf(start.settings))}, cost);
    if (best.settings.empty() || found.cost < best.cost) best = std::move(found);
  }
  return best;
}

// What a dial shows.
Settings Rounded(const Lamps& lamps, const Settings& settings) {
  std::vector<FixtureState> states;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    FixtureState state = settings[i].state;
    for (const auto& axis : lamps[i]->AxesAt(state)) {
      double& number = state[axis.control].number;
      number = std::clamp(std::round(number / axis.step) * axis.step, axis.least, axis.most);
      number = std::round(number * 1e6) / 1e6;
    }
    states.push_back(std::move(state));
  }
  return SettingsAt(lamps, states).value_or(settings);
}

Settings Nearest(const Lamps& lamps, const LightPoint& target) {
  const Cost color = ColorCost(target);
  const Found nearest = LeastOf(lamps, {BestCandidate(lamps, color)}, color);
  const Cost light = LightCost(target, nearest.cost * kUnnoticedUv);
  return Rounded(lamps, LeastOf(lamps, {nearest, BestCandidate(lamps, light)}, light).settings);
}

// ---- how sure ----

LightPoint Drawn(const LightPoint& point, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double mired = normal(random) * point.sd_ln_mired;
  const double duv = normal(random) * point.sd_duv;
  const double across = normal(random) * point.sd_duv;
  LightPoint drawn = point;
  drawn.level *= std::exp(point.sd_ln_level * normal(random));
  if (const CctResult cct = CctFromXy(point.xy); cct.valid()) {
    drawn.xy = XyFromCct(Kelvin(cct.temperature.value() * std::exp(mired)), cct.duv + duv);
  } else {
    const Uv1960 uv = Uv1960FromXy(point.xy);
    drawn.xy = XyFromUv1960({uv.u + across, uv.v + duv});
  }
  return drawn;
}

Uncertain DrawnInterval(double value, std::vector<double> drawn) {
  if (drawn.size() < 40) return {value, 0.0, {}, {}};
  std::ranges::sort(drawn);
  const auto rank = [&](double p) {
    return drawn[static_cast<std::size_t>(std::lround(p * static_cast<double>(drawn.size() - 1)))];
  };
  const double low = std::min(value, rank(0.025));
  const double high = std::max(value, rank(0.975));
  return {value, (high - low) / 2.0, low, high};
}

StateMatch Described(Settings settings, const StateMatchRequest& request) {
  StateMatch match;
  match.point = SumOf(settings);
  std::vector<double> kelvin;
  std::vector<double> duv;
  std::vector<double> stops;
  std::vector<double> off;
  std::mt19937_64 random(kStateMatchSeed);
  for (int i = 0; i < request.draws; ++i) {
    Settings drawn = settings;
    for (LampSetting& one : drawn) one.point = Drawn(one.point, random);
    const LightPoint sum = SumOf(drawn);
    const LightPoint target = Drawn(request.target, random);
    off.push_back(UvBetween(sum.xy, target.xy));
    if (const auto over = StopsOver(sum, target)) stops.push_back(*over);
    if (const CctResult cct = CctFromXy(sum.xy); cct.valid()) {
      kelvin.push_back(cct.temperature.value());
      duv.push_back(cct.duv);
    }
  }
  match.delta_uv = DrawnInterval(UvBetween(match.point.xy, request.target.xy), std::move(off));
  if (const CctResult cct = CctFromXy(match.point.xy); cct.valid()) {
    match.cct_K = DrawnInterval(cct.temperature.value(), std::move(kelvin));
    match.duv = DrawnInterval(cct.duv, std::move(duv));
  }
  if (const auto over = StopsOver(match.point, request.target)) {
    match.dimmer_stops = DrawnInterval(*over, std::move(stops));
  }
  if (settings.size() == 1 && settings.front().relative && *settings.front().relative > 0.0) {
    match.stops_lost = -std::log2(*settings.front().relative);
  }
  match.lamps = std::move(settings);
  return match;
}

// Outcomes of a setting beside their 1 sigma: u', v' and, where it is compared, ln of the light.
struct Outcomes {
  std::array<double, 3> value{};
  std::array<double, 3> sd{};
  int count = 2;
};

Outcomes OutcomesOf(const LightPoint& point, const LightPoint& target) {
  const Uv1976 uv = Uv1976FromXy(point.xy);
  Outcomes out;
  out.value = {uv.u, uv.v, point.level > 0.0 ? std::log(point.level) : 0.0};
  // A mired's step along the locus and a Duv's across it, taken alike in u' and v'.
  const CctResult cct = CctFromXy(point.xy);
  const auto sd_of = [&](const LightPoint& one) {
    if (!cct.valid()) return 1.5 * one.sd_duv;
    const Xy moved = XyFromCct(Kelvin(cct.temperature.value() * (1.0 + one.sd_ln_mired)), cct.duv);
    return std::hypot(UvBetween(moved, point.xy), one.sd_duv);
  };
  const double sd = std::max(1e-5, std::hypot(sd_of(point), sd_of(target)));
  out.sd = {sd, sd, std::max(1e-5, std::hypot(point.sd_ln_level, target.sd_ln_level))};
  if (StopsOver(point, target)) out.count = 3;
  return out;
}

// Solves a x = b in place for one column a side; false where a is singular.
bool Invert(std::vector<std::vector<double>>& a) {
  const std::size_t n = a.size();
  std::vector<std::vector<double>> inverse(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) inverse[i][i] = 1.0;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r) {
      if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
    }
    if (!(std::abs(a[pivot][c]) > 1e-9)) return false;
    std::swap(a[c], a[pivot]);
    std::swap(inverse[c], inverse[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const double factor = a[r][c] / a[c][c];
      for (std::size_t k = 0; k < n; ++k) {
        a[r][k] -= factor * a[c][k];
        inverse[r][k] -= factor * inverse[c][k];
      }
    }
  }
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t k = 0; k < n; ++k) inverse[r][k] /= a[r][r];
  }
  a = std::move(inverse);
  return true;
}

struct Slope {
  std::size_t lamp = 0;
  LampSettings::Axis axis;
  std::array<double, 3> of{};  // per range of the control, over the outcome's sd
};

std::optional<Slope> SlopeAlong(const Lamps& lamps, const Settings& settings,
                                const LightPoint& target, std::size_t lamp,
                                const LampSettings::Axis& axis) {
  constexpr double kPart = 0.02;
  std::array<Outcomes, 2> ends;
  std::array<double, 2> at{};
  for (std::size_t e = 0; e < 2; ++e) {
    FixtureState state = settings[lamp].state;
    double& number = state[axis.control].number;
    number = std::clamp(number + (e == 0 ? -kPart : kPart) * (axis.most - axis.least), axis.least,
                        axis.most);
    at[e] = number;
    auto one = lamps[lamp]->At(state);
    if (!one) return std::nullopt;
    Settings there = settings;
    there[lamp] = *std::move(one);
    ends[e] = OutcomesOf(SumOf(there), target);
  }
  if (!(at[1] > at[0])) return std::nullopt;
  Slope slope{lamp, axis, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    slope.of[k] =
        (ends[1].value[k] - ends[0].value[k]) / (at[1] - at[0]) * (axis.most - axis.least);
  }
  return slope;
}

// (J^T J)^-1 of the outcomes over their sigmas: where the labels may stand that give this light.
void SetLabelIntervals(const Lamps& lamps, const LightPoint& target, StateMatch& match) {
  std::vector<Slope> slopes;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    for (const auto& axis : lamps[i]->AxesAt(match.lamps[i].state)) {
      const auto slope = SlopeAlong(lamps, match.lamps, target, i, axis);
      if (!slope) return;
      slopes.push_back(*slope);
    }
  }
  LightPoint with_sd = match.point;
  for (const LampSetting& one : match.lamps) {
    with_sd.sd_ln_mired = std::max(with_sd.sd_ln_mired, one.point.sd_ln_mired);
    with_sd.sd_duv = std::max(with_sd.sd_duv, one.point.sd_duv);
    with_sd.sd_ln_level = std::max(with_sd.sd_ln_level, one.point.sd_ln_level);
  }
  const Outcomes here = OutcomesOf(with_sd, target);
  // More labels than outcomes: many settings give the same light, and none is to be named surer.
  if (slopes.empty() || slopes.size() > static_cast<std::size_t>(here.count)) return;
  std::vector<std::vector<double>> normal(slopes.size(), std::vector<double>(slopes.size(), 0.0));
  for (std::size_t a = 0; a < slopes.size(); ++a) {
    for (std::size_t b = 0; b < slopes.size(); ++b) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(here.count); ++k) {
        normal[a][b] += slopes[a].of[k] * slopes[b].of[k] / (here.sd[k] * here.sd[k]);
      }
    }
  }
  if (!Invert(normal)) return;
  for (std::size_t a = 0; a < slopes.size(); ++a) {
    const auto& axis = slopes[a].axis;
    const ControlValue& control = match.lamps[slopes[a].lamp].state[axis.control];
    const double range = axis.most - axis.least;
    const double u95 = kZ95 * std::sqrt(std::max(0.0, normal[a][a])) * range;
    if (!std::isfinite(u95) || u95 > range) continue;  // the whole range: no label is told
    match.lamps[slopes[a].lamp].u95.push_back({control.name, u95});
  }
}

tl::unexpected<Error> NoColor(const std::string& name) {
  return Refused("no_color", name,
                 "no colour of it is known; read its xy or its CCT, or give its spectrum");
}

std::string ToldPoint(const StateMatch& match) {
  const auto& xy = match.point.xy;
  std::string text =
      Joined(match.lamps, " with ", [](const LampSetting& one) { return StateText(one.state); });
  text += ", leaves " + RoundedText(match.delta_uv.value, 2) + " in u'v' (";
  if (match.cct_K && match.duv) {
    return text + RoundedText(match.cct_K->value, 4) + " K, Duv " +
           RoundedText(match.duv->value, 2) + ")";
  }
  return text + "x " + RoundedText(xy.x, 3) + ", y " + RoundedText(xy.y, 3) + ")";
}

double LightOff(const StateMatch& match) {
  if (match.dimmer_stops) return std::abs(match.dimmer_stops->value);
  return match.stops_lost.value_or(0.0);
}

}  // namespace

Result<StateMatches> MatchStates(const SettableLamp& lamp, const StateMatchRequest& request) {
  const LampSettings settings(lamp);
  if (settings.read().empty()) return NoColor(lamp.name);
  const Lamps lamps = {&settings};
  StateMatches answer;
  StateMatch best = Described(Nearest(lamps, request.target), request);
  if (best.delta_uv.value > request.reach) {
    return Refused("unreachable", "target",
                   "no setting of " + lamp.name + " between those that were read comes within " +
                       RoundedText(request.reach, 2) + " of it in u'v'; the nearest, " +
                       ToldPoint(best) + "; gel it, mix it with another lamp, or {match.reach}");
  }
  SetLabelIntervals(lamps, request.target, best);
  answer.matches.push_back(std::move(best));
  std::vector<StateMatch> read;
  for (const LampSetting& one : settings.read()) read.push_back(Described({one}, request));
  answer.unfiltered = read.front();
  std::ranges::stable_sort(read, [](const StateMatch& a, const StateMatch& b) {
    const auto step = [](const StateMatch& m) {
      return std::floor(m.delta_uv.value / kUnnoticedUv);
    };
    return std::pair(step(a), LightOff(a)) < std::pair(step(b), LightOff(b));
  });
  for (StateMatch& one : read) {
    if (static_cast<int>(answer.matches.size()) >= request.count) break;
    const bool is_best =
        SameState(one.lamps.front().state, answer.matches.front().lamps.front().state);
    const bool bettered = std::any_of(answer.matches.begin() + 1, answer.matches.end(),
                                      [&](const StateMatch& better) {
                                        return LightOff(better) <= LightOff(one) + kUnnoticedStops;
                                      });
    if (!is_best && !bettered) answer.matches.push_back(std::move(one));
  }
  return answer;
}

Result<StateMatch> MixStates(const SettableLamp& lamp, const SettableLamp& with,
                             const StateMatchRequest& request) {
  const LampSettings first(lamp);
  const LampSettings second(with);
  const Lamps lamps = {&first, &second};
  const std::array<const SettableLamp*, 2> named = {&lamp, &with};
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    if (lamps[i]->read().empty()) return NoColor(named[i]->name);
    const LevelKind kind = lamps[i]->read().front().point.kind;
    if (kind != LevelKind::kNone && kind == first.read().front().point.kind) continue;
    return Refused("no_level", named[i]->name,
                   "how much each lamp gives must be known of both in one unit, in candela or in "
                   "lux where the meter stood, to add them");
  }
  StateMatch mix = Described(Nearest(lamps, request.target), request);
  if (mix.delta_uv.value > request.reach) {
    return Refused("unreachable", "target",
                   "no two settings of " + lamp.name + " and " + with.name +
                       " add up to it: the nearest, " + ToldPoint(mix) +
                       "; gel one of them first, take another lamp, or {match.reach}");
  }
  SetLabelIntervals(lamps, request.target, mix);
  return mix;
}

}  // namespace lightcal
