// SPDX-License-Identifier: Apache-2.0
#include "lightcal/match/gelled_light.h"

#include <cmath>
#include <optional>

namespace lightcal::match {
namespace {

// Relative standard deviation of what passes, by the stops' interval.
double PassingSigma(const Match& match) {
  if (!match.intervals) return 0.0;
  return match.intervals->stops_lost.u95 / kZ95 * std::log(2.0);
}

Uncertain Dimmed(const Uncertain& whole, double factor, double sigma) {
  Uncertain out;
  out.value = whole.value * factor;
  const double extra = kZ95 * sigma * whole.value;
  out.u95 = factor * std::hypot(whole.u95, extra);
  if (whole.low) out.low = out.value - factor * std::hypot(whole.value - *whole.low, extra);
  if (whole.high) out.high = out.value + factor * std::hypot(*whole.high - whole.value, extra);
  return out;
}

FittedColor ColorOf(const Match& match) {
  FittedColor color;
  color.xy = match.xy;
  if (!match.cct.valid()) return color;
  color.cct_K = Uncertain{match.cct.temperature.value(), 0.0, std::nullopt, std::nullopt};
  color.duv = Uncertain{match.cct.duv, 0.0, std::nullopt, std::nullopt};
  if (match.intervals && match.intervals->cct_K) color.cct_K = match.intervals->cct_K;
  if (match.intervals && match.intervals->duv) color.duv = match.intervals->duv;
  return color;
}

}  // namespace

FittedLight LightBehind(const FittedLight& light, const Match& match) {
  const double factor = std::exp2(-match.stops_lost);
  const double sigma = PassingSigma(match);
  FittedLight out = light;
  for (std::optional<Uncertain>* each :
       {&out.intensity_cd, &out.flux_lm, &out.illuminance_lx, &out.luminance_nits}) {
    if (*each) *each = Dimmed(**each, factor, sigma);
  }
  if (out.distribution) out.distribution->table = out.distribution->table.Scaled(factor);
  if (out.covariance_lnI_d0_E0) (*out.covariance_lnI_d0_E0)[0] += sigma * sigma;
  out.ambient_lx.reset();
  out.color = ColorOf(match);
  out.effects.clear();
  out.residuals.clear();
  out.budget.clear();
  return out;
}

Result<FittedLight> LightAtMeter(const MatchRequest& request, const Match& match,
                                 const std::string& name) {
  if (request.lamp.quantity != SpectralQuantity::kIrradiance) {
    return Refused("no_level", name,
                   "its spectrum is relative, so nobody knows how bright it is; take a light.json "
                   "or a spectrum in W m^-2 nm^-1");
  }
  FittedLight light;
  light.name = name;
  light.kind = LightKind::kDirectional;
  const double lux = XyzFromSpectrum(request.lamp)->Y;
  light.illuminance_lx = UncertainFromNormal(lux, request.spread.level * lux);
  return LightBehind(light, match);
}

}  // namespace lightcal::match
