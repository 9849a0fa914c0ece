// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/states/match_states.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "lightcal/calibrate/states/settable_lamp.h"
#include "lightcal/calibrate/states/setting_intervals.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kUnnoticedUv = 0.0005;
constexpr double kNoticedUv = 0.001;
constexpr double kUnnoticedStops = 0.05;
constexpr int kHalvings = 8;
constexpr int kMostMoves = 120;
constexpr double kLeastCostGain = 2e-3;  // of a cost: 1e-6 in u'v', 0.002 stops
constexpr double kFar = 1e9;

// What a setting costs; kFar and more where it is none.
struct Cost {
  Xy sought;  // the colour that a setting is to lie near
  std::function<double(const LightPoint&)> of;

  double operator()(const LightPoint& point) const { return of(point); }
};

Cost ColorCost(const LightPoint& target) {
  return {target.xy, [&target](const LightPoint& point) {
            return UvBetween(point.xy, target.xy) / kUnnoticedUv;
          }};
}

// How far along the locus from the target's CCT; of those as far the nearest colour.
Cost CctCost(const LightPoint& target) {
  return {target.xy, [&target, duv = CctFromXy(target.xy).duv](const LightPoint& point) {
            const CctResult cct = CctFromXy(point.xy);
            if (!cct.valid()) return kFar;
            const double along = UvBetween(XyFromCct(cct.temperature, duv), target.xy);
            return (along + 0.01 * UvBetween(point.xy, target.xy)) / kUnnoticedUv;
          }};
}

// Light, among the colours that nobody tells apart from the nearest one; where that is no farther
// from the target, among those as near to the target. (Not so for one farther: a lamp whose colours
// pass the target at a distance d would go sqrt(2 d kUnnoticedUv) along them for light, 0.003 of
// d = 0.01.)
Cost LightCost(const LightPoint& target, Xy nearest, const Cost& color) {
  const double off = UvBetween(nearest, target.xy);
  const bool met = off <= kUnnoticedUv;
  const Xy sought = met ? target.xy : nearest;
  const double within = kUnnoticedUv + (met ? off : 0.0);
  return {sought, [&target, &color, sought, within](const LightPoint& point) {
            const double beyond = std::max(0.0, UvBetween(point.xy, sought) - within);
            const auto stops = StopsOver(point, target);
            const double light = stops               ? std::abs(*stops)
                                 : point.level > 0.0 ? 100.0 - std::log2(point.level)
                                                     : 1000.0;
            return light + 0.01 * color(point) + 1e4 * beyond / kUnnoticedUv;
          }};
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

struct Dial {
  std::size_t lamp = 0;
  LampSettings::Axis axis;
};

std::vector<Dial> DialsOf(const Lamps& lamps, const Settings& settings) {
  std::vector<Dial> dials;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    for (const auto& axis : lamps[i]->AxesAt(settings[i].state)) dials.push_back({i, axis});
  }
  return dials;
}

// A dial turned by a part of its range, no farther than it goes.
std::optional<Settings> Turned(const Lamps& lamps, Settings settings, const Dial& dial,
                               double part) {
  const auto& axis = dial.axis;
  FixtureState state = settings[dial.lamp].state;
  double& number = state[axis.control].number;
  number = std::clamp(number + part * (axis.most - axis.least), axis.least, axis.most);
  auto one = lamps[dial.lamp]->At(state);
  if (!one) return std::nullopt;
  settings[dial.lamp] = *std::move(one);
  return settings;
}

// How a dial moves the colour in u'v' where it stands, a whole range of it.
struct DialSlope {
  Uv1976 from;
  double u = 0.0, v = 0.0;
};
std::optional<DialSlope> SlopeOf(const Lamps& lamps, const Settings& settings, const Dial& dial) {
  constexpr double kPart = 0.005;
  const auto& axis = dial.axis;
  const double here = settings[dial.lamp].state[axis.control].number;
  const double part = here + kPart * (axis.most - axis.least) <= axis.most ? kPart : -kPart;
  const auto beside = Turned(lamps, settings, dial, part);
  if (!beside) return std::nullopt;
  const Uv1976 from = Uv1976FromXy(SumOf(settings).xy);
  const Uv1976 to = Uv1976FromXy(SumOf(*beside).xy);
  return DialSlope{from, (to.u - from.u) / part, (to.v - from.v) / part};
}

// That dial turned until the colour is nearest to `wanted_xy`.
std::optional<Settings> TurnedBack(const Lamps& lamps, const Settings& settings, const Dial& dial,
                                   const std::optional<DialSlope>& slope, Xy wanted_xy) {
  const double square = slope ? slope->u * slope->u + slope->v * slope->v : 0.0;
  if (!(square > 1e-8)) return std::nullopt;
  const Uv1976 wanted = Uv1976FromXy(wanted_xy);
  return Turned(
      lamps, settings, dial,
      ((wanted.u - slope->from.u) * slope->u + (wanted.v - slope->from.v) * slope->v) / square);
}

// A setting that costs less: one dial turned by `step` of its range, or where none alone helps,
// one turned and another turned back to the same colour, or to the one sought. Light at a colour is
// a narrow valley that leans across the dials wherever a dimmer moves the colour; at the edge of
// what is near enough the same colour is not to be had again, and one nearer to that sought may be.
std::optional<Found> Bettered(const Lamps& lamps, const Found& from, double step,
                              const Cost& cost) {
  const std::vector<Dial> dials = DialsOf(lamps, from.settings);
  const auto better = [&](std::optional<Settings> settings) -> std::optional<Found> {
    if (!settings) return std::nullopt;
    const double value = cost(SumOf(*settings));
    if (!(value < from.cost - kLeastCostGain)) return std::nullopt;
    return Found{*std::move(settings), value};
  };
  std::vector<std::pair<std::size_t, Settings>> tried;
  for (std::size_t i = 0; i < dials.size(); ++i) {
    for (const double sign : {1.0, -1.0}) {
      auto settings = Turned(lamps, from.settings, dials[i], sign * step);
      if (!settings) continue;
      if (auto found = better(settings)) return found;
      tried.emplace_back(i, *std::move(settings));
    }
  }
  std::vector<std::optional<DialSlope>> slopes;  // found for the first colour
  for (const Xy wanted : {SumOf(from.settings).xy, cost.sought}) {
    std::size_t at = 0;
    for (const auto& [turned, settings] : tried) {
      for (std::size_t i = 0; i < dials.size(); ++i) {
        if (i == turned) continue;
        if (at == slopes.size()) slopes.push_back(SlopeOf(lamps, settings, dials[i]));
        const auto& slope = slopes[at++];
        if (auto found = better(TurnedBack(lamps, settings, dials[i], slope, wanted))) return found;
      }
    }
  }
  return std::nullopt;
}

// From a sixteenth of the dials' ranges, halved where nothing helps.
Found Descend(const Lamps& lamps, Found from, const Cost& cost) {
  double step = 0.0625;
  int moves = 0;
  for (int halvings = 0; halvings < kHalvings;) {
    auto found = Bettered(lamps, from, step, cost);
    if (found) from = *std::move(found);
    if (found && ++moves < kMostMoves) continue;
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

// Of a lamp that is matched to itself.
std::optional<Settings> StateOfTarget(const Lamps& lamps, const LightPoint& target) {
  const bool same = lamps.size() == 1 && !target.lamp.empty() &&
                    lamps.front()->read().front().point.lamp == target.lamp;
  return same ? SettingsAt(lamps, {target.state}) : std::nullopt;
}

Settings Nearest(const Lamps& lamps, const LightPoint& target, const Cost& color) {
  if (auto own = StateOfTarget(lamps, target)) return *std::move(own);
  const Found nearest = LeastOf(lamps, {BestCandidate(lamps, color)}, color);
  const Cost light = LightCost(target, SumOf(nearest.settings).xy, color);
  return Rounded(lamps, LeastOf(lamps, {nearest, BestCandidate(lamps, light)}, light).settings);
}

StateMatch NearestMatch(const Lamps& lamps, const StateMatchRequest& request) {
  StateMatch best =
      DescribedMatch(Nearest(lamps, request.target, ColorCost(request.target)), request);
  // Of a lamp that is matched to itself there is nothing that a label may be off by.
  if (!StateOfTarget(lamps, request.target)) SetLabelIntervals(lamps, request.target, best);
  return best;
}

// Where the lamps have the target's CCT, if the nearest colour is seen to have another.
std::optional<StateMatch> SameCctMatch(const Lamps& lamps, const StateMatchRequest& request,
                                       const StateMatch& best) {
  const CctResult wanted = CctFromXy(request.target.xy);
  if (!wanted.valid() || !best.cct_K) return std::nullopt;
  const auto off = [&](const StateMatch& match) {
    return UvBetween(XyFromCct(Kelvin(match.cct_K->value), wanted.duv), request.target.xy);
  };
  if (off(best) <= kNoticedUv) return std::nullopt;
  StateMatch same =
      DescribedMatch(Nearest(lamps, request.target, CctCost(request.target)), request);
  if (!same.cct_K || off(same) > kUnnoticedUv) return std::nullopt;
  SetLabelIntervals(lamps, request.target, same);
  return same;
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
  StateMatch best = NearestMatch(lamps, request);
  if (best.delta_uv.value > request.reach) {
    return Refused("unreachable", "target",
                   "no setting of " + lamp.name + " between those that were read comes within " +
                       RoundedText(request.reach, 2) + " of it in u'v'; the nearest, " +
                       ToldPoint(best) + "; gel it, mix it with another lamp, or {match.reach}");
  }
  answer.same_cct = SameCctMatch(lamps, request, best);
  answer.matches.push_back(std::move(best));
  std::vector<StateMatch> read;
  for (const LampSetting& one : settings.read()) read.push_back(DescribedMatch({one}, request));
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

Result<StateMix> MixStates(const SettableLamp& lamp, const SettableLamp& with,
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
  StateMix mix = {NearestMatch(lamps, request), std::nullopt};
  if (mix.nearest.delta_uv.value > request.reach) {
    return Refused("unreachable", "target",
                   "no two settings of " + lamp.name + " and " + with.name +
                       " add up to it: the nearest, " + ToldPoint(mix.nearest) +
                       "; gel one of them first, take another lamp, or {match.reach}");
  }
  mix.same_cct = SameCctMatch(lamps, request, mix.nearest);
  return mix;
}

}  // namespace lightcal
