// SPDX-License-Identifier: Apache-2.0
// The cheapest form of an area light's illuminance whose error a one-line bound keeps under a
// tolerance. Bounds are relative to the truth and were verified on a million random scenes each, at
// six tolerances from 5e-2 to 1e-9, without a violation (tests/light/ladder_test.cc).
#pragma once

#include <cmath>
#include <cstdint>

#include "lightcal/light/models/disk_source.h"
#include "lightcal/light/models/rect_source.h"
#include "lightcal/light/models/tube_source.h"

namespace lightcal {

enum class LadderLevel : std::uint8_t {
  kPoint,
  kGauss2,  // rect: 2 x 2 Gauss-Legendre points, 3 x 3, 4 x 4
  kGauss3,
  kGauss4,
  kLine,    // tube: without thickness
  kStrips,  // tube: six generators of the mantle
  kExact,
};

//   rect   K (a/d)^2n (1 + 1/cr),  a the half diagonal, K 1.25 (point), .9, .5, .25 (n = 2, 3, 4),
// the last two .75 within 2a, while d > a and the lowest corner stands above the horizon. The
// reference's .42 and .18 fail beside the rim, near the source's own plane.
template <class T>
[[nodiscard]] LadderLevel ChooseLevel(const RectSource& source, const Receiver<T>& at,
                                      double tolerance) {
  using S = Scalar<T>;
  using std::sqrt;
  const T d2 = Dot(at.position, at.position);
  const S size2 = static_cast<S>(source.half_width * source.half_width +
                                 source.half_height * source.half_height);
  const T toward = -Dot(at.normal, at.position);
  if (!(toward > S(0)) || !(toward * toward > size2)) return LadderLevel::kExact;
  const S tol = static_cast<S>(tolerance);
  const T x = size2 / d2;
  const T grazing = S(1) + sqrt(d2) / toward;
  T power = x * grazing;
  if (S(1.25) * power <= tol) return LadderLevel::kPoint;
  power *= x;
  if (S(0.9) * power <= tol) return LadderLevel::kGauss2;
  power *= x;
  const bool near = x > S(0.25);
  if ((near ? S(0.75) : S(0.5)) * power <= tol) return LadderLevel::kGauss3;
  power *= x;
  return (near ? S(0.75) : S(0.25)) * power <= tol ? LadderLevel::kGauss4 : LadderLevel::kExact;
}
template <class T>
[[nodiscard]] T LuxPerCandelaAt(LadderLevel level, const RectSource& source,
                                const Receiver<T>& at) {
  if (!(at.position[2] > Scalar<T>(0))) return T(0);
  switch (level) {
    case LadderLevel::kPoint:
      return models::FlatPointLuxPerCandela(at);
    case LadderLevel::kGauss2:
      return models::RectMean<2>(source, at);
    case LadderLevel::kGauss3:
      return models::RectMean<3>(source, at);
    case LadderLevel::kGauss4:
      return models::RectMean<4>(source, at);
    default:
      return LuxPerCandela(source, at);
  }
}

//   disk   point: 0.65 (R/d)^2 (1 + 1/cr) while the disk stands above the horizon; the closed form
// costs less than any quadrature, so there is nothing between.
template <class T>
[[nodiscard]] LadderLevel ChooseLevel(const DiskSource& source, const Receiver<T>& at,
                                      double tolerance) {
  using S = Scalar<T>;
  using std::sqrt;
  const T d2 = Dot(at.position, at.position);
  const S r2 = static_cast<S>(source.radius * source.radius);
  const T toward = -Dot(at.normal, at.position);
  if (!(toward > S(0)) || !(toward * toward > r2)) return LadderLevel::kExact;
  return S(0.65) * r2 / d2 * (S(1) + sqrt(d2) / toward) <= static_cast<S>(tolerance)
             ? LadderLevel::kPoint
             : LadderLevel::kExact;
}
template <class T>
[[nodiscard]] T LuxPerCandelaAt(LadderLevel level, const DiskSource& source,
                                const Receiver<T>& at) {
  return level == LadderLevel::kPoint ? models::FlatPointLuxPerCandela(at)
                                      : LuxPerCandela(source, at);
}

namespace models {

// The mantle by N generators, evenly about the one nearest to the receiver.
template <int N, class T>
[[nodiscard]] T StripsLuxPerCandela(const TubeSource& source, const Receiver<T>& at) {
  using S = Scalar<T>;
  using std::acos;
  const AtTube<T> m = FromAxis(at);
  const S l = static_cast<S>(source.half_length);
  const S r = static_cast<S>(source.radius);
  const T limit = acos(T(r / m.away));
  T sum(0);
  for (int i = 0; i < N; ++i) {
    sum += static_cast<S>(GaussLegendre<N>::kWeight[i]) *
           Generator(m, l, r, T(limit * static_cast<S>(GaussLegendre<N>::kNode[i])));
  }
  return limit * sum / (S(2) * l);
}

// The tube seen as a point: square to its axis, as its sine.
template <class T>
[[nodiscard]] T TubePointLuxPerCandela(const Receiver<T>& at) {
  using std::sqrt;
  const AtTube<T> m = FromAxis(at);
  return PointLuxPerCandela(at) * m.away / sqrt(Dot(at.position, at.position));
}

}  // namespace models

// With rho the distance from the axis, h the height of the mantle's lowest point over the horizon,
// l the half length:
//   line   2.2 B,  B = R/rho + R/h, while B < .1
//   point  2.2 (B + (l/d)^2 (1 + d/h)), while that is below .2 and d > 1.5 l
//   strips 4e-7, 4e-6, 2e-4 for R/rho up to .01, .05, .2
template <class T>
[[nodiscard]] LadderLevel ChooseLevel(const TubeSource& source, const Receiver<T>& at,
                                      double tolerance) {
  using S = Scalar<T>;
  using std::abs;
  using std::sqrt;
  const S l = static_cast<S>(source.half_length);
  const S r = static_cast<S>(source.radius);
  const models::AtTube<T> m = models::FromAxis(at);
  const T radial = sqrt(m.n_away * m.n_away + m.n_across * m.n_across);
  const T low = -Dot(at.normal, at.position) - abs(m.n_along) * l - radial * r;
  if (!(low > S(0)) || !(m.away > S(5) * r)) return LadderLevel::kExact;
  const S tol = static_cast<S>(tolerance);
  const T thickness = r / m.away + r / low;
  const T d2 = Dot(at.position, at.position);
  const T length = l * l / d2 * (S(1) + sqrt(d2) / low);
  const S far = S(0.1);
  if (thickness < far && d2 > S(2.25) * l * l && thickness + length < far &&
      S(2.2) * (thickness + length) <= tol) {
    return LadderLevel::kPoint;
  }
  if (thickness < far && S(2.2) * thickness <= tol) return LadderLevel::kLine;
  const T slender = r / m.away;
  const S strips = slender < S(0.01) ? S(4e-7) : (slender < S(0.05) ? S(4e-6) : S(2e-4));
  return strips <= tol ? LadderLevel::kStrips : LadderLevel::kExact;
}
template <class T>
[[nodiscard]] T LuxPerCandelaAt(LadderLevel level, const TubeSource& source,
                                const Receiver<T>& at) {
  switch (level) {
    case LadderLevel::kPoint:
      return models::TubePointLuxPerCandela(at);
    case LadderLevel::kLine:
      return models::LineLuxPerCandela(source, at);
    case LadderLevel::kStrips:
      return models::StripsLuxPerCandela<6>(source, at);
    default:
      return LuxPerCandela(source, at);
  }
}

// At the level its own bound allows. (A sphere and a spot have one form, which is exact.)
template <class Source, class T>
[[nodiscard]] T LuxPerCandela(const Source& source, const Receiver<T>& at, double tolerance) {
  return LuxPerCandelaAt(ChooseLevel(source, at, tolerance), source, at);
}

}  // namespace lightcal
