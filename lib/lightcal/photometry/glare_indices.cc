// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/glare_indices.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightcal {
namespace {

constexpr double kMostPositionIndex = 16.0;

// sum of L^2 w/P^2: what four formulas weigh sources by.
double WeighedSources(std::span<const GlareSource> sources) {
  double sum = 0.0;
  for (const GlareSource& source : sources) {
    const double seen = source.luminance.value() / source.position_index;
    sum += seen * seen * source.solid_angle.value();
  }
  return sum;
}

}  // namespace

double PositionIndex(const Vec3& direction) {
  const auto& [right, ahead, up] = direction;
  const double aside = std::hypot(right, up);
  if (up < 0.0) {
    const double r = ahead > 0.0 ? std::min(aside / ahead, 3.0) : 3.0;
    return 1.0 + (r < 0.6 ? 0.8 : 1.2) * r;
  }
  const double s = std::atan2(aside, ahead) / kRadiansPerDegree;
  const double t = std::atan2(std::abs(right), up) / kRadiansPerDegree;
  const double first = 35.2 - 0.31889 * t - 1.22 * std::exp(-2.0 * t / 9.0);
  const double second = 21.0 + 0.26667 * t - 0.002963 * t * t;
  return std::min(kMostPositionIndex, std::exp(first * s / 1e3 + second * s * s / 1e5));
}

Nits GlareLight::background() const {
  return Nits(std::max(0.0, (vertical.value() - direct.value()) / std::numbers::pi));
}

double DaylightGlareProbability(const GlareLight& light, std::span<const GlareSource> sources,
                                bool dim) {
  const double ev = light.vertical.value();
  if (!(ev > 0.0)) return 0.0;
  const double contrast = WeighedSources(sources) / std::pow(ev, 1.87);
  double dgp = 5.87e-5 * ev + 0.0918 * std::log10(1.0 + contrast) + 0.16;
  if (dim && ev < 1000.0) dgp /= 1.0 + std::exp(4.0 - 0.024 * ev);
  return std::min(dgp, 1.0);
}

std::optional<double> UnifiedGlareRating(const GlareLight& light,
                                         std::span<const GlareSource> sources) {
  const double sum = WeighedSources(sources), background = light.background().value();
  if (!(sum > 0.0 && background > 0.0)) return std::nullopt;
  return 8.0 * std::log10(0.25 / background * sum);
}

std::optional<double> DaylightGlareIndex(const GlareLight& light,
                                         std::span<const GlareSource> sources) {
  const double background = light.background().value();
  if (!(background > 0.0)) return std::nullopt;
  double sum = 0.0;
  for (const GlareSource& source : sources) {
    const double l = source.luminance.value(), w = source.solid_angle.value();
    const double p = source.position_index;
    if (!(l > 0.0)) continue;
    sum += 0.478 * std::pow(l, 1.6) * std::pow(w / (p * p), 0.8) /
           (background + 0.07 * std::sqrt(w) * l);
  }
  if (!(sum > 0.0)) return std::nullopt;
  return 10.0 * std::log10(sum);
}

std::optional<double> CieGlareIndex(const GlareLight& light, std::span<const GlareSource> sources) {
  const double sum = WeighedSources(sources), ev = light.vertical.value();
  if (!(sum > 0.0 && ev > 0.0)) return std::nullopt;
  return 8.0 * std::log10(2.0 * (1.0 + light.direct.value() / 500.0) / ev * sum);
}

}  // namespace lightcal
