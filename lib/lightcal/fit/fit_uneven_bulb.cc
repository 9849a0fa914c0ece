// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/fit_uneven_bulb.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "lightcal/core/uncertain.h"
#include "lightcal/fit/fit_by_distance.h"
#include "lightcal/fit/model/off_axis.h"
#include "lightcal/fit/model/uneven_light.h"

namespace lightcal::fit {
namespace {

// Standard deviations of what bulbs do: within them a bulb is one, and a point nobody calls so.
constexpr double kOfStated = 3.0, kOfAnyPoint = 2.5;

bool ReadAside(const Observation& row) { return row.lit && row.off_axis_rad != 0.0; }

// What was read aside over what an even lamp would give there, and 1 sigma of its logarithm.
struct SeenAside {
  double off_axis_rad = 0.0, ratio = 1.0, sd = 0.0;
};
std::vector<SeenAside> AsideOf(const FittedLight& bulb, const LightDescription& light,
                               const Observations& observations) {
  std::vector<SeenAside> out;
  for (const ResidualRow& row : bulb.residuals) {
    const auto at = std::ranges::find(observations.rows, row.index, &Observation::index);
    if (at == observations.rows.end() || !ReadAside(*at) || at->over_range) continue;
    out.push_back({std::abs(at->off_axis_rad), 1.0 + row.relative,
                   std::hypot(UnevenAside(light, Radians(at->off_axis_rad)), row.sigma_relative)});
  }
  return out;
}

bool MayBeBulb(const LightDescription& light, const Observations& observations) {
  if (light.kind != LightKind::kPoint || light.beam || light.field) return false;
  if (std::ranges::none_of(observations.rows, ReadAside)) return false;
  if (light.fixture) return light.fixture == Fixture::kBulb;
  double nearest = std::numeric_limits<double>::infinity(), widest = 0.0;
  for (const Observation& row : observations.rows) {
    if (!row.lit) continue;
    nearest = std::min(nearest, std::abs(row.off_axis_rad));
    widest = std::max(widest, std::abs(row.off_axis_rad));
  }
  return widest - nearest >= kEvenSpan_rad;
}

// Of what nobody calls a bulb no reading tells whether it shines beyond the widest angle.
void HoldInFlux(const std::vector<SeenAside>& aside, bool stated, const Uncertain& intensity,
                Uncertain& flux) {
  constexpr double kTwoPi = 2.0 * std::numbers::pi;
  double dimmest = 1.0, brightest = 1.0, widest = 0.0;
  for (const SeenAside& one : aside) {
    dimmest = std::min(dimmest, one.ratio);
    brightest = std::max(brightest, one.ratio);
    widest = std::max(widest, one.off_axis_rad);
  }
  const double seen = kTwoPi * (1.0 - std::cos(std::min(widest, std::numbers::pi)));
  flux.low = (stated ? LowEnd(flux) : LowEnd(intensity) * seen) * dimmest;
  flux.high = HighEnd(flux) * brightest;
  flux.u95 = 0.5 * (*flux.high - *flux.low);
}

}  // namespace

std::optional<FittedLight> FitUnevenBulb(const Session& session, const LightDescription& light,
                                         const Observations& observations,
                                         const FitSettings& settings, const FittedLight& out,
                                         FittedSession& session_out) {
  if (!MayBeBulb(light, observations)) return std::nullopt;
  FittedSession said;
  Result<FittedLight> fitted = FitByDistance(session, light, observations, settings, out, said);
  if (!fitted || !fitted->intensity_cd) return std::nullopt;
  const std::vector<SeenAside> aside = AsideOf(*fitted, light, observations);
  const double within = light.fixture ? kOfStated : kOfAnyPoint;
  const bool as_bulbs_do = std::ranges::all_of(aside, [within](const SeenAside& one) {
    return one.ratio > 0.0 && std::abs(std::log(one.ratio)) <= within * one.sd;
  });
  if (!as_bulbs_do) return std::nullopt;
  if (fitted->flux_lm) {
    HoldInFlux(aside, light.fixture.has_value(), *fitted->intensity_cd, *fitted->flux_lm);
  }
  session_out.Warn(std::move(said.warnings));
  std::ranges::move(said.notes, std::back_inserter(session_out.notes));
  return *std::move(fitted);
}

}  // namespace lightcal::fit
