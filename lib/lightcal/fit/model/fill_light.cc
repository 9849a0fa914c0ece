// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/fill_light.h"

#include <algorithm>
#include <cmath>

#include "lightcal/core/uncertain.h"
#include "lightcal/fit/beam/stated_beam.h"
#include "lightcal/fit/model/data_sheet.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/photometry/source_photometry.h"

namespace lightcal::fit {
namespace {

// Parameters of which light.json keeps the covariance: ln I, d0, E0.
constexpr int kPredicting = 3;

std::optional<double> ValueOf(const std::optional<Metres>& length) {
  if (!length) return std::nullopt;
  return length->value();
}

SourceGeometry GeometryOf(const LightDescription& light) {
  SourceGeometry geometry;
  geometry.kind = light.kind;
  if (light.radius) geometry.radius = *light.radius;
  if (light.diameter) geometry.radius = *light.diameter / 2.0;
  geometry.width = light.width;
  geometry.height = light.height;
  geometry.length = light.length;
  if (light.outer) geometry.cone = SpotCone{light.inner.value_or(Radians(0.0)), *light.outer};
  return geometry;
}

// What scales with the intensity shares its relative interval.
Uncertain ScaledTo(const Uncertain& intensity, double value) {
  const double ratio = value / intensity.value;
  Uncertain u{value, intensity.u95 * ratio, std::nullopt, std::nullopt};
  if (intensity.low) u.low = *intensity.low * ratio;
  if (intensity.high) u.high = *intensity.high * ratio;
  return u;
}

// Its own interval: that of the intensity and that of the pattern, side by side.
Uncertain FluxOf(const LightDescription& light, const Uncertain& intensity, double model_lm) {
  Uncertain flux = ScaledTo(intensity, model_lm);
  const FluxSpread spread = FluxSpreadOf(light);
  const double least = std::max(LowEnd(intensity), 0.0);
  const double most = HighEnd(intensity);
  const double down = std::log(std::max(least / intensity.value, 1e-9));
  flux.low = model_lm * std::exp(-std::hypot(down, std::log(spread.low)));
  flux.high =
      model_lm * std::exp(std::hypot(std::log(most / intensity.value), std::log(spread.high)));
  flux.u95 = 0.5 * (*flux.high - *flux.low);
  return flux;
}

// The file's shape, as bright as the readings say.
void AddTable(const IntensityTable& table, FittedLight& out) {
  const Uncertain& intensity = *out.intensity_cd;
  out.of_file = ScaledTo(intensity, intensity.value / table.peak().intensity.value());
  IntensityTable scaled = table.Scaled(intensity.value / table.peak().intensity.value());
  out.flux_lm = ScaledTo(intensity, scaled.Flux().value());
  out.distribution = MeasuredDistribution{std::move(scaled)};
}

// An interval that need not be symmetric.
Uncertain Within(double value, double low, double high) {
  return {value, 0.5 * (high - low), low, high};
}

}  // namespace

FittedLight Describe(const LightDescription& light) {
  FittedLight out;
  out.name = light.name;
  out.kind = light.kind;
  out.diameter_m = ValueOf(light.diameter);
  out.width_m = ValueOf(light.width);
  out.height_m = ValueOf(light.height);
  out.length_m = ValueOf(light.length);
  out.radius_m = ValueOf(light.radius);
  if (light.inner) out.inner_deg = DegreesFromRadians(*light.inner);
  if (light.outer) out.outer_deg = DegreesFromRadians(*light.outer);
  out.position_m = light.position_m;
  out.aim = light.aim;
  out.axis = light.axis;
  return out;
}

void AddDerivedQuantities(const LightDescription& light, FittedLight& out) {
  if (!out.intensity_cd) return;
  if (light.distribution) return AddTable(*light.distribution, out);
  if (light.kind == LightKind::kPhotometric) return;
  const Uncertain& intensity = *out.intensity_cd;
  if (const auto beams = BeamsOf(light)) {
    const double middle = std::sqrt(beams->least.value() * beams->most.value());
    out.flux_lm = FluxOf(light, intensity, intensity.value * middle);
    return;
  }
  const SourceGeometry geometry = GeometryOf(light);
  const auto photometry = ConvertSource(geometry, SourceQuantity::kIntensity, intensity.value);
  if (!photometry) return;  // a size this kind needs is not given
  if (photometry->flux) out.flux_lm = FluxOf(light, intensity, photometry->flux->value());
  const bool has_surface = light.kind == LightKind::kSphere || light.kind == LightKind::kDisk ||
                           light.kind == LightKind::kRect || light.kind == LightKind::kTube;
  if (has_surface && photometry->luminance) {
    out.luminance_nits = ScaledTo(intensity, photometry->luminance->value());
    WidenInLn(*out.luminance_nits, 1.0, light.face_sd);
  }
}

void FillParameters(const LightEstimate& estimate, bool distance_law, FittedLight& out) {
  if (estimate.upper_limit) {
    const Uncertain limit{0.5 * *estimate.upper_limit, 0.5 * *estimate.upper_limit, 0.0,
                          *estimate.upper_limit};
    (distance_law ? out.intensity_cd : out.illuminance_lx) = limit;
    return;
  }
  Uncertain main =
      UncertainFromLog(estimate.theta[kLnIntensity], SdOf(estimate.covariance, kLnIntensity));
  if (estimate.ln_interval) {
    main = Within(main.value, std::exp(estimate.ln_interval->low),
                  std::exp(estimate.ln_interval->high));
  } else if (estimate.sampled) {
    const SampledParameter& ln = estimate.sampled->parameters[kLnIntensity];
    main = Within(main.value, std::exp(ln.low), std::exp(ln.high));
  }
  if (distance_law) {
    out.intensity_cd = main;
    out.distance_offset_m = UncertainFromNormal(estimate.theta[kDistanceOffset],
                                                SdOf(estimate.covariance, kDistanceOffset));
    if (estimate.sampled) {
      const SampledParameter& d0 = estimate.sampled->parameters[kDistanceOffset];
      out.distance_offset_m = Within(estimate.theta[kDistanceOffset], d0.low, d0.high);
    }
  } else {
    out.illuminance_lx = main;
  }
  Uncertain ambient =
      UncertainFromNormal(estimate.theta[kAmbient], SdOf(estimate.covariance, kAmbient));
  if (ambient.value < ambient.u95) {  // illuminance cannot be negative: a one-sided interval
    ambient.low = 0.0;
    ambient.high = ambient.value + ambient.u95;
  }
  if (estimate.sampled && estimate.ambient_free) {
    const SampledParameter& e0 = estimate.sampled->parameters[kAmbient];
    ambient = Within(ambient.value, std::max(0.0, e0.low), e0.high);
  }
  out.ambient_lx = ambient;
  out.in_room = estimate.in_room;
  out.covariance_lnI_d0_E0.emplace();
  for (int i = 0; i < kPredicting; ++i) {
    for (int j = 0; j < kPredicting; ++j) {
      (*out.covariance_lnI_d0_E0)[i * kPredicting + j] = estimate.covariance[i * kParameters + j];
    }
  }
}

}  // namespace lightcal::fit
