// SPDX-License-Identifier: Apache-2.0
// A reading somewhere in or around a spot's beam whose cone and aim are being found.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "lightcal/core/vec3.h"
#include "lightcal/light/models/receiver.h"
#include "lightcal/photometry/spot_profile.h"

namespace lightcal::fit {

// ln I, d0, logit of outer/(pi/2), logit of inner/outer, and the aim's tilts about the start's x
// and y: aim ~ z + a x + b y in the start's frame.
enum SpotParameter : std::uint8_t {
  kSpotLnIntensity = 0,
  kSpotOffset = 1,
  kSpotOuter = 2,
  kSpotInner = 3,
  kSpotAimX = 4,
  kSpotAimY = 5,
};
inline constexpr int kSpotParameters = 6;

struct SpotReading {
  Vec3 from_lamp{};  // in the start's frame
  Vec3 normal{};
  double measured = 0.0;
  double sigma = 1.0;
};

template <class T>
[[nodiscard]] T LogisticOf(const T& x) {
  using std::exp;
  return 1.0 / (1.0 + exp(-x));
}

template <class T>
[[nodiscard]] T SpotIlluminance(const SpotReading& reading, const T* p) {
  using std::exp;
  using std::sqrt;
  const T outer = 0.5 * std::numbers::pi * LogisticOf(p[kSpotOuter]);
  const T inner = outer * LogisticOf(p[kSpotInner]);
  const T length = sqrt(1.0 + p[kSpotAimX] * p[kSpotAimX] + p[kSpotAimY] * p[kSpotAimY]);
  const Vec3Of<T> aim = {p[kSpotAimX] / length, p[kSpotAimY] / length, 1.0 / length};
  const Vec3Of<T> v = Vec3Of<T>(reading.from_lamp + aim * p[kSpotOffset]);
  const T r2 = Dot(v, v);
  const T r = sqrt(r2);
  const T facing = -Dot(v, reading.normal) / r;
  if (!(facing > T(0.0))) return T(0.0);
  const Vec3Of<T> across = Cross(v, aim);
  const T along = Dot(v, aim);
  const T s = along > T(0.0) ? T(Dot(across, across) / (2.0 * r * (r + along)))
                             : T((r - along) / (2.0 * r));
  return exp(p[kSpotLnIntensity]) * facing / r2 *
         SpotProfile(s, HalfVersine(inner), HalfVersine(outer), SpotFalloff::kSquaredLinear);
}

}  // namespace lightcal::fit
