// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/light_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightcal {
namespace {

bool IsOn(const FittedLight& light, std::string_view effect) {
  return std::ranges::any_of(light.effects, [&](const EffectReport& e) {
    return e.name == effect && e.state == EffectState::kOn;
  });
}

std::optional<Metres> AsLength(const std::optional<double>& metres) {
  if (!metres) return std::nullopt;
  return Metres(*metres);
}

AxialShape ShapeOf(const FittedLight& light) {
  if (!IsOn(light, "finite_source")) return {};
  return AxialShapeOf(
      light.kind, {AsLength(light.diameter_m), AsLength(light.width_m), AsLength(light.height_m),
                   AsLength(light.length_m), AsLength(light.radius_m)});
}

}  // namespace

double SurfaceRadius_m(const FittedLight& light) {
  const bool sphere = light.kind == LightKind::kSphere;
  return sphere && IsOn(light, "sphere_surface") ? light.diameter_m.value_or(0.0) / 2.0 : 0.0;
}

std::optional<LightCurve> LightCurve::Of(const FittedLight& light) {
  if (!light.intensity_cd || !(light.intensity_cd->value > 0.0)) return std::nullopt;
  LightCurve curve;
  curve.intensity_cd_ = light.intensity_cd->value;
  curve.offset_m_ = SurfaceRadius_m(light);
  if (light.distance_offset_m) curve.offset_m_ += light.distance_offset_m->value;
  curve.ambient_lx_ = light.ambient_lx ? light.ambient_lx->value : 0.0;
  curve.shape_ = ShapeOf(light);
  curve.covariance_ = light.covariance_lnI_d0_E0;
  return curve;
}

double LightCurve::DirectAt(double r) const {
  return intensity_cd_ * AxialShapeFactor(shape_, r) / (r * r);
}

double LightCurve::LuxAt(double distance_m) const {
  return DirectAt(distance_m + offset_m_) + ambient_lx_;
}

std::optional<double> LightCurve::SdOfLogAt(double distance_m) const {
  if (!covariance_) return std::nullopt;
  constexpr double kStep = 1e-4;  // of r, for the central difference
  const double r = distance_m + offset_m_;
  const double lux = LuxAt(distance_m);
  const double by_offset =
      (DirectAt(r * (1.0 + kStep)) - DirectAt(r * (1.0 - kStep))) / (2.0 * kStep * r);
  const std::array<double, 3> gradient = {DirectAt(r) / lux, by_offset / lux, 1.0 / lux};
  double variance = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      variance += gradient[i] * gradient[j] * (*covariance_)[3 * i + j];
    }
  }
  return std::sqrt(std::max(0.0, variance));
}

}  // namespace lightcal
