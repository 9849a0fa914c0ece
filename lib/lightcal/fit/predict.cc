// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/reading_model.h"
#include "lightcal/fit/model/solve.h"

namespace lightcal {
namespace {

std::optional<Metres> Length(const std::optional<double>& metres) {
  if (!metres) return std::nullopt;
  return Metres(*metres);
}

bool IsOn(const FittedLight& light, std::string_view effect) {
  return std::any_of(light.effects.begin(), light.effects.end(), [&](const EffectReport& e) {
    return e.name == effect && e.state == EffectState::kOn;
  });
}

fit::ReadingRow RowAt(const FittedLight& light, double distance_m) {
  fit::ReadingRow row;
  row.distance = distance_m;
  if (IsOn(light, "finite_source")) {
    row.shape = AxialShapeOf(
        light.kind, {Length(light.diameter_m), Length(light.width_m), Length(light.height_m),
                     Length(light.length_m), Length(light.radius_m)});
  }
  if (light.kind == LightKind::kSphere && IsOn(light, "sphere_surface")) {
    row.distance += 0.5 * light.diameter_m.value_or(0.0);
  }
  // So that the whitened residual is -ln E.
  row.measured = 1.0;
  row.sigma = 1.0;
  return row;
}

// Standard deviation of ln I of an estimate that has no covariance: a data sheet's.
double SdOfLog(const Uncertain& u) {
  if (u.low && u.high && *u.low > 0.0) return std::log(*u.high / *u.low) / (2.0 * kZ95);
  return u.u95 / (u.value * kZ95);
}

double VarianceOfLog(const FittedLight& light, const Uncertain& strength,
                     const std::array<double, fit::kParameters>& gradient) {
  if (!light.covariance_lnI_d0_E0) {
    const double sd = SdOfLog(strength);
    return gradient[0] * gradient[0] * sd * sd;
  }
  double variance = 0.0;
  constexpr int kKept = 3;
  for (int i = 0; i < kKept; ++i) {
    for (int j = 0; j < kKept; ++j) {
      variance += gradient[i] * gradient[j] * (*light.covariance_lnI_d0_E0)[i * kKept + j];
    }
  }
  return std::max(0.0, variance);
}

}  // namespace

Result<PredictedIlluminance> PredictIlluminance(const FittedLight& light, Metres distance,
                                                double sigma_relative) {
  const bool no_distance = light.illuminance_lx.has_value();
  const auto& strength = no_distance ? light.illuminance_lx : light.intensity_cd;
  if (!strength || !(strength->value > 0.0)) {
    return Refused("no_intensity", light.name, "the light has no intensity to predict from");
  }
  const double d0 = light.distance_offset_m ? light.distance_offset_m->value : 0.0;
  const double ambient = light.ambient_lx ? light.ambient_lx->value : 0.0;
  const fit::ReadingRow row = RowAt(light, no_distance ? 1.0 : distance.value());
  if (!(distance.value() > 0.0) || !(row.distance + d0 > 0.0)) {
    return Refused("bad_distance", light.name,
                   "no illuminance is defined " + ShortestText(distance.value()) +
                       " m from the lamp: its effective source lies there or beyond");
  }
  const fit::Theta theta = {std::log(strength->value), d0, ambient};
  const fit::RowDerivative at = fit::DifferentiateRow(row, theta);
  const double variance = VarianceOfLog(light, *strength, at.gradient);
  return PredictedIlluminance{
      UncertainFromLog(-at.residual, std::sqrt(variance)),
      UncertainFromLog(-at.residual, std::sqrt(variance + sigma_relative * sigma_relative))};
}

}  // namespace lightcal
