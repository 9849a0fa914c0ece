// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/hypotheses.h"
#include "lightcal/fit/model/reading_model.h"
#include "lightcal/fit/model/solve.h"
#include "lightcal/light/wall_prior.h"

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

// One of the things that lamp and room may be, at one distance.
struct AtDistance {
  double ln_whole = 0.0, variance = 0.0;
  double ln_walls = 0.0, walls_variance = 0.0;
};

AtDistance Of(const LampInRoom& one, const fit::ReadingRow& bare, double distance_m) {
  constexpr int n = LampInRoom::kCount;
  fit::ReadingRow row = bare;
  if (one.width_m > 0.0) {
    SourceSize size;
    size.width = Metres(one.width_m);
    size.height = Metres(one.height_m);
    row.shape = AxialShapeOf(LightKind::kRect, size);
  }
  const double x = std::log(distance_m / kWallReference_m);
  row.walls = fit::WallsOfRow{x, one.bend * x * x, one.scatter};
  const fit::Theta theta = {one.ln_intensity, one.distance_offset_m, one.ambient_lx, one.ln_b,
                            one.slope};
  const fit::RowDerivative whole = fit::DifferentiateRow(row, theta);
  const std::array<double, fit::kParameters> walls = {1.0, 0.0, 0.0, 1.0, x};
  const auto variance = [&](const std::array<double, fit::kParameters>& gradient) {
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) sum += gradient[i] * gradient[j] * one.covariance[i * n + j];
    }
    return std::max(0.0, sum);
  };
  AtDistance out;
  out.ln_whole = -whole.residual;
  out.ln_walls = one.ln_intensity + std::log(fit::WallsPerCandela(row, theta.data()));
  const double share = std::exp(out.ln_walls - out.ln_whole);
  out.variance = variance(whole.gradient) + std::pow(share * one.scatter, 2.0);
  out.walls_variance = variance(walls) + one.scatter * one.scatter;
  return out;
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

Result<std::optional<IlluminanceInRoom>> PredictInRoom(const FittedLight& light, Metres distance,
                                                       double sigma_relative) {
  const auto alone = PredictIlluminance(light, distance, sigma_relative);
  if (!alone) return tl::unexpected(alone.error());
  if (light.in_room.empty()) return std::optional<IlluminanceInRoom>();
  const fit::ReadingRow bare = RowAt(light, distance.value());
  std::vector<fit::NormalPart> whole;
  std::vector<fit::NormalPart> reading;
  std::vector<fit::NormalPart> walls;
  for (const LampInRoom& one : light.in_room) {
    if (!(bare.distance + one.distance_offset_m > 0.0)) continue;
    const AtDistance at = Of(one, bare, distance.value());
    whole.push_back({one.weight, at.ln_whole, std::sqrt(at.variance)});
    reading.push_back({one.weight, at.ln_whole, std::hypot(whole.back().sd, sigma_relative)});
    walls.push_back({one.weight, at.ln_walls, std::sqrt(at.walls_variance)});
  }
  if (whole.empty()) return std::optional<IlluminanceInRoom>();
  return IlluminanceInRoom{fit::UncertainFromLogMixture(whole),
                           fit::UncertainFromLogMixture(reading),
                           fit::UncertainFromLogMixture(walls)};
}

}  // namespace lightcal
