// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/states/setting_intervals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/standard_normal.h"
#include "lightcal/core/statistics.h"
#include "lightcal/core/uncertain.h"

namespace lightcal {
namespace {

constexpr std::uint64_t kStateMatchSeed = 20260123;

LightPoint Drawn(const LightPoint& point, std::mt19937_64& random) {
  StandardNormal normal;
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
  const double low = std::min(value, Quantile(drawn, 0.025));
  const double high = std::max(value, Quantile(drawn, 0.975));
  return {value, (high - low) / 2.0, low, high};
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

}  // namespace lightcal
