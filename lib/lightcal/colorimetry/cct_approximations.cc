// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/cct_approximations.h"

#include <cmath>

namespace lightcal {
namespace {

constexpr double kLargestDuv = 0.05 + 1e-9;  // CIE 15:2018 9.4
constexpr double kColdest = 1000.0;

}  // namespace

Kelvin HernandezAndresCct(Xy xy) {
  const double n = (xy.x - 0.3366) / (xy.y - 0.1735);
  return Kelvin(-949.86315 + 6253.80338 * std::exp(-n / 0.92159) +
                28.70599 * std::exp(-n / 0.20039) + 0.00004 * std::exp(-n / 0.07125));
}

Kelvin McCamyCct(Xy xy) {
  const double n = (xy.x - 0.3320) / (0.1858 - xy.y);
  return Kelvin(((449.0 * n + 3525.0) * n + 6823.3) * n + 5520.33);
}

CctResult CctFromXy(Xy xy, CctMethod method) {
  if (method == CctMethod::kExact) return CctFromXy(xy);
  const bool usable = std::isfinite(xy.x) && std::isfinite(xy.y) && xy.y > 0.0;
  if (!usable) return {};
  CctResult out;
  out.temperature = method == CctMethod::kMcCamy ? McCamyCct(xy) : HernandezAndresCct(xy);
  if (!std::isfinite(out.temperature.value()) || out.temperature.value() <= 0.0) {
    out.status = CctStatus::kBeyondInfinity;
    return out;
  }
  const Uv1960 own = Uv1960FromXy(xy);
  const Uv1960 locus = UvFromCct(out.temperature);
  out.duv = std::copysign(std::hypot(own.u - locus.u, own.v - locus.v), own.v - locus.v);
  out.status = std::abs(out.duv) > kLargestDuv      ? CctStatus::kFarFromLocus
               : out.temperature.value() < kColdest ? CctStatus::kBelowRange
                                                    : CctStatus::kOk;
  return out;
}

}  // namespace lightcal
