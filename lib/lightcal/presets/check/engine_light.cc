// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/engine_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightcal {
namespace {

double Clamp01(double v) { return std::clamp(v, 0.0, 1.0); }

double SmoothStep(double t) { return t * t * (3.0 - 2.0 * t); }

double ProfileValue(const std::vector<double>& profile, double cosine) {
  const double at = std::acos(std::clamp(cosine, -1.0, 1.0)) / std::numbers::pi *
                        static_cast<double>(profile.size()) -
                    0.5;
  const double last = static_cast<double>(profile.size() - 1);
  const double low = std::floor(std::clamp(at, 0.0, last - 1.0));
  const auto i = static_cast<std::size_t>(low);
  return profile[i] + (profile[i + 1] - profile[i]) * Clamp01(at - low);
}

double Cone(const EngineLight& light, double cosine) {
  if (light.profile.size() > 1) return ProfileValue(light.profile, cosine);
  return ConeAt({light.law, light.inner_rad, light.outer_rad, light.cone_power}, cosine);
}

double Window(const EngineLight& light, double d) {
  if (!(light.range_m > 0.0)) return 1.0;
  return std::pow(Clamp01(1.0 - std::pow(d / light.range_m, 4)), light.window_power);
}

// Sum over small pieces of L cos cos dA/d^2.
double FlatLux(const EngineLight& light, const Vec3& point, const Vec3& normal) {
  constexpr int kPieces = 64;
  const double area = light.width_m * light.height_m / (kPieces * kPieces);
  double sum = 0.0;
  int inside = 0;
  for (int i = 0; i < kPieces; ++i) {
    for (int j = 0; j < kPieces; ++j) {
      const double u = (i + 0.5) / kPieces - 0.5;
      const double v = (j + 0.5) / kPieces - 0.5;
      if (light.round && u * u + v * v > 0.25) continue;
      ++inside;
      const Vec3 to = point - (light.position_m + light.x * (u * light.width_m) +
                               light.y * (v * light.height_m));
      const double d2 = Dot(to, to);
      sum += std::max(0.0, Dot(to, light.aim)) * std::max(0.0, -Dot(to, normal)) / (d2 * d2);
    }
  }
  // The squares inside a circle are not quite its area.
  const double whole = light.round ? std::numbers::pi / 4.0 * kPieces * kPieces / inside : 1.0;
  return light.emitted * area * whole * sum;
}

// The same over a mantle.
double TubeLux(const EngineLight& light, const Vec3& point, const Vec3& normal) {
  constexpr int kPieces = 64;
  const Vec3 side = Cross(light.x, light.y);
  const double radius = light.height_m / 2.0;
  const double area = light.width_m / kPieces * 2.0 * std::numbers::pi * radius / kPieces;
  double sum = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    const Vec3 centre = light.position_m + light.x * (((i + 0.5) / kPieces - 0.5) * light.width_m);
    for (int j = 0; j < kPieces; ++j) {
      const double turn = 2.0 * std::numbers::pi * (j + 0.5) / kPieces;
      const Vec3 outward = light.y * std::cos(turn) + side * std::sin(turn);
      const Vec3 to = point - (centre + outward * radius);
      const double d2 = Dot(to, to);
      sum += std::max(0.0, Dot(to, outward)) * std::max(0.0, -Dot(to, normal)) / (d2 * d2);
    }
  }
  return light.emitted * area * sum;
}

}  // namespace

double ConeAt(const ConeOfLaw& cone, double cosine) {
  const double outer = std::cos(cone.outer_rad);
  if (cone.law == ConeLaw::kSmoothInAngle || cone.law == ConeLaw::kLinearInAngle) {
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    const double edge = std::max(1e-9, cone.outer_rad - cone.inner_rad);
    const double s = Clamp01((cone.outer_rad - angle) / edge);
    return cone.law == ConeLaw::kLinearInAngle ? s : SmoothStep(s);
  }
  if (cone.law == ConeLaw::kPower) {
    const double rim = (1.0 - cosine) / std::max(1e-9, 1.0 - outer);
    return rim < 1.0 ? 1.0 - std::pow(std::max(rim, 1e-4), cone.power) : 0.0;
  }
  const double t = Clamp01((cosine - outer) / std::max(1e-9, std::cos(cone.inner_rad) - outer));
  return cone.law == ConeLaw::kSquared ? t * t : SmoothStep(t);
}

double LuxAt(const EngineLight& light, const Vec3& point, const Vec3& normal) {
  if (light.kind == EngineLightKind::kDome) return std::numbers::pi * light.emitted;
  if (light.kind == EngineLightKind::kSun) {
    return light.emitted * std::max(0.0, -Dot(light.aim, normal));
  }
  if (light.kind == EngineLightKind::kFlat) return FlatLux(light, point, normal);
  if (light.kind == EngineLightKind::kTube) return TubeLux(light, point, normal);
  const Vec3 to = point - light.position_m;
  const double d = Length(to);
  if (!(d > 0.0)) return 0.0;
  double candela = light.emitted * Window(light, d);
  if (light.kind == EngineLightKind::kSpot) candela *= Cone(light, Dot(to, light.aim) / d);
  if (light.kind == EngineLightKind::kTable) {
    candela *=
        light.table->Towards({Dot(to, light.x), Dot(to, light.y), -Dot(to, light.aim)}).value();
  }
  return candela * std::max(0.0, -Dot(to, normal)) / d / std::pow(d, light.decay);
}

}  // namespace lightcal
