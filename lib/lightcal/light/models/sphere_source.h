// SPDX-License-Identifier: Apache-2.0
// A globe of one luminance, from any distance, cut by the receiver's horizon where it is.
#pragma once

#include <cmath>
#include <numbers>

#include "lightcal/light/models/point_source.h"

namespace lightcal {

struct SphereSource {
  double radius = 0.0;
};

namespace models {

// atan(z) - z; by its series where the difference cancels.
template <class T>
[[nodiscard]] T AtanMinusArgument(const T& z) {
  using S = Scalar<T>;
  using std::atan;
  if (z > S(0.25)) return atan(z) - z;
  const T z2 = z * z;
  T sum(0);
  for (int k = 23; k >= 3; k -= 2) {
    const S term = (k % 4 == 3 ? S(-1) : S(1)) / S(k);
    sum = sum * z2 + term;
  }
  return z * z2 * sum;
}

// Illuminance over luminance of a disk of directions, half angle asin(s), whose middle stands at
// cosine `cr` from the receiver's normal; 0 < s < 1.
//   |cr| >= s: pi s^2 max(0, cr).   Across the horizon, with q = (s-cr)(s+cr), z = sqrt(q/(1-s^2)),
//   A = atan2(sqrt(q)/(s sqrt(1-cr^2)), -cr sqrt((1-s^2)/(1-cr^2))/s):
//   s^2 (cr A + z) + (atan z - z).
template <class T>
[[nodiscard]] T LuxPerNitOfDirections(const T& s, const T& cr) {
  using S = Scalar<T>;
  using std::atan2;
  using std::sqrt;
  const T s2 = s * s;
  if (cr >= s) return S(std::numbers::pi) * s2 * cr;
  const T q = (s - cr) * (s + cr);
  if (!(cr > -s) || !(q > S(0))) return T(0);
  const T cos2 = (S(1) - s) * (S(1) + s);
  const T sin2_normal = (S(1) - cr) * (S(1) + cr);
  const T root = sqrt(q);
  const T z = root / sqrt(cos2);
  const T angle = atan2(root / (s * sqrt(sin2_normal)), -cr * sqrt(cos2 / sin2_normal) / s);
  const T sum = s2 * (cr * angle + z) + AtanMinusArgument(z);
  return sum > S(0) ? sum : T(0);
}

}  // namespace models

// Axial intensity I = pi R^2 L, the same toward every direction:
//   above the horizon (cr >= R/d) exactly max(0, cr)/d^2, d to the centre; below it 0; between,
//   models::LuxPerNitOfDirections over pi R^2; inside (d <= R) 1/R^2.                  [lx/cd]
// Relative error below 1e-12 for d/R from 1.001 to 1e6, of its value in the middle of the horizon.
// Source: Lagarde & de Rousiers, Moving Frostbite to PBR (2014), illuminanceSphereOrDisk, rewritten
// without its cancellation.
template <class T>
[[nodiscard]] T LuxPerCandela(const SphereSource& source, const Receiver<T>& at) {
  using S = Scalar<T>;
  using std::sqrt;
  const S radius = static_cast<S>(source.radius);
  if (!(radius > S(0))) return PointLuxPerCandela(at);
  const T d2 = Dot(at.position, at.position);
  if (!(d2 > radius * radius)) return T(S(1) / (radius * radius));
  const T toward = -Dot(at.normal, at.position);
  if (toward >= radius) return PointLuxPerCandela(at);
  if (!(toward > -radius)) return T(0);
  const T d = sqrt(d2);
  return models::LuxPerNitOfDirections(T(radius / d), T(toward / d)) /
         (S(std::numbers::pi) * radius * radius);
}

// A sun: E/E_perp of light that fills directions of half angle `angular_radius` [rad] about
// `toward_light`, E_perp on a surface that faces it. Only while the disk crosses the horizon does
// it differ from the cosine.
template <class T>
[[nodiscard]] T SunFactor(const Vec3Of<T>& normal, const Vec3Of<T>& toward_light,
                          double angular_radius) {
  using S = Scalar<T>;
  const S s = static_cast<S>(std::sin(angular_radius));
  if (!(s > S(0))) return DirectionalFactor(normal, toward_light);
  return models::LuxPerNitOfDirections(T(s), T(Dot(normal, toward_light))) /
         (S(std::numbers::pi) * s * s);
}

}  // namespace lightcal
