// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/states/setting_intervals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "lightcal/calibrate/states/common_errors.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/statistics.h"
#include "lightcal/core/uncertain.h"

namespace lightcal {
namespace {

constexpr std::uint64_t kStateMatchSeed = 20260123;

Uncertain DrawnInterval(double value, std::vector<double> drawn) {
  if (drawn.size() < 40) return {value, 0.0, {}, {}};
  const double low = std::min(value, Quantile(drawn, 0.025));
  const double high = std::max(value, Quantile(drawn, 0.975));
  return {value, (high - low) / 2.0, low, high};
}

Uv1976 UvStep(Xy from, Xy to) {
  const Uv1976 a = Uv1976FromXy(from);
  const Uv1976 b = Uv1976FromXy(to);
  return {b.u - a.u, b.v - a.v};
}

// Of how far apart two colours are. Noise makes a distance longer and never shorter than 0, so that
// its least is by what is drawn along the way from one to the other, which may be of either sign.
Uncertain DistanceInterval(Uv1976 found, const std::vector<Uv1976>& drawn) {
  const double distance = std::hypot(found.u, found.v);
  std::vector<double> along, whole;
  for (const Uv1976& one : drawn) {
    whole.push_back(std::hypot(one.u, one.v));
    along.push_back(distance > 0.0 ? (one.u * found.u + one.v * found.v) / distance : 0.0);
  }
  if (drawn.size() < 40) return {distance, 0.0, {}, {}};
  const double low = std::clamp(Quantile(along, 0.025), 0.0, distance);
  const double high = std::max(distance, Quantile(whole, 0.975));
  return {distance, (high - low) / 2.0, low, high};
}

// Outcomes of a setting: u', v' and, where it is compared, ln of the light.
struct Outcomes {
  std::array<double, 3> value{};
  int count = 2;
};

Outcomes OutcomesOf(const LightPoint& point, const LightPoint& target) {
  const Uv1976 uv = Uv1976FromXy(point.xy);
  Outcomes out;
  out.value = {uv.u, uv.v, point.level > 0.0 ? std::log(point.level) : 0.0};
  if (StopsOver(point, target)) out.count = 3;
  return out;
}

// 1 sigma of the outcomes beside the target's, of several lamps the worst.
std::array<double, 3> SdOfOutcomes(const StateMatch& match, const LightPoint& target) {
  LightErrors apart;
  for (const LampSetting& one : match.lamps) {
    const LightErrors errors = ErrorsApart(one.point, target);
    apart.ln_mired = std::max(apart.ln_mired, errors.ln_mired);
    apart.duv = std::max(apart.duv, errors.duv);
    apart.ln_level = std::max(apart.ln_level, errors.ln_level);
  }
  // A mired's step along the locus and a Duv's across it, taken alike in u' and v'.
  double sd = 1.5 * apart.duv;
  if (const CctResult cct = CctFromXy(match.point.xy); cct.valid()) {
    const Xy moved = XyFromCct(Kelvin(cct.temperature.value() * (1.0 + apart.ln_mired)), cct.duv);
    sd = std::hypot(UvBetween(moved, match.point.xy), apart.duv);
  }
  sd = std::max(1e-5, sd);
  return {sd, sd, std::max(1e-5, apart.ln_level)};
}

// The inverse, in place; false where there is none.
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

}  // namespace

StateMatch DescribedMatch(Settings settings, const StateMatchRequest& request) {
  StateMatch match;
  match.point = SumOf(settings);
  std::vector<double> kelvin, duv, stops, kelvin_off, duv_off;
  std::vector<Uv1976> off;
  std::vector<LightPoint> points = {request.target};
  for (const LampSetting& one : settings) points.push_back(one.point);
  const auto with_target = [&](const auto& same) {
    return std::all_of(points.begin() + 1, points.end(),
                       [&](const LightPoint& one) { return same(one, request.target); });
  };
  match.color_cancels = with_target(ColorErrorCancels);
  match.level_cancels = with_target(LevelErrorCancels);
  DrawnPoints draws(std::move(points), kStateMatchSeed);
  Settings drawn = settings;
  for (int i = 0; i < request.draws; ++i) {
    const std::vector<LightPoint> all = draws.Next();
    const LightPoint& target = all.front();
    for (std::size_t k = 0; k < drawn.size(); ++k) drawn[k].point = all[k + 1];
    const LightPoint sum = SumOf(drawn);
    off.push_back(UvStep(target.xy, sum.xy));
    if (const auto over = StopsOver(sum, target)) stops.push_back(*over);
    const CctResult cct = CctFromXy(sum.xy);
    if (!cct.valid()) continue;
    kelvin.push_back(cct.temperature.value());
    duv.push_back(cct.duv);
    const CctResult wanted = CctFromXy(target.xy);
    if (!wanted.valid()) continue;
    kelvin_off.push_back(cct.temperature.value() - wanted.temperature.value());
    duv_off.push_back(cct.duv - wanted.duv);
  }
  match.delta_uv = DistanceInterval(UvStep(request.target.xy, match.point.xy), off);
  if (const CctResult cct = CctFromXy(match.point.xy); cct.valid()) {
    match.cct_K = DrawnInterval(cct.temperature.value(), std::move(kelvin));
    match.duv = DrawnInterval(cct.duv, std::move(duv));
    if (const CctResult wanted = CctFromXy(request.target.xy); wanted.valid()) {
      match.delta_cct_K = DrawnInterval(cct.temperature.value() - wanted.temperature.value(),
                                        std::move(kelvin_off));
      match.delta_duv = DrawnInterval(cct.duv - wanted.duv, std::move(duv_off));
    }
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

void SetLabelIntervals(const Lamps& lamps, const LightPoint& target, StateMatch& match) {
  std::vector<Slope> slopes;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    for (const auto& axis : lamps[i]->AxesAt(match.lamps[i].state)) {
      const auto slope = SlopeAlong(lamps, match.lamps, target, i, axis);
      if (!slope) return;
      slopes.push_back(*slope);
    }
  }
  const Outcomes here = OutcomesOf(match.point, target);
  const std::array<double, 3> sd = SdOfOutcomes(match, target);
  // More labels than outcomes: many settings give the same light, and none is to be named surer.
  if (slopes.empty() || slopes.size() > static_cast<std::size_t>(here.count)) return;
  std::vector<std::vector<double>> normal(slopes.size(), std::vector<double>(slopes.size(), 0.0));
  for (std::size_t a = 0; a < slopes.size(); ++a) {
    for (std::size_t b = 0; b < slopes.size(); ++b) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(here.count); ++k) {
        normal[a][b] += slopes[a].of[k] * slopes[b].of[k] / (sd[k] * sd[k]);
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

}  // namespace lightcal
