// SPDX-License-Identifier: Apache-2.0
// A cylinder whose mantle has one luminance and whose ends are dark, for a meter anywhere outside.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "lightcal/light/models/gauss_legendre.h"
#include "lightcal/light/models/line_integral.h"
#include "lightcal/light/models/point_source.h"

namespace lightcal {

struct TubeSource {
  double half_length = 0.0;  // along x
  double radius = 0.0;
};

namespace models {

// The receiver in the tube's own coordinates: along the axis, away from it, and its normal along
// the axis, outward, and across.
template <class T>
struct AtTube {
  T along, away;
  T n_along, n_away, n_across;
};
template <class T>
[[nodiscard]] AtTube<T> FromAxis(const Receiver<T>& at) {
  using S = Scalar<T>;
  using std::sqrt;
  const T away2 = at.position[1] * at.position[1] + at.position[2] * at.position[2];
  if (!(away2 > S(0))) return {at.position[0], T(0), at.normal[0], T(0), T(0)};
  const T away = sqrt(away2);
  const T y = at.position[1] / away;
  const T z = at.position[2] / away;
  return {at.position[0], away, at.normal[0], at.normal[1] * y + at.normal[2] * z,
          at.normal[2] * y - at.normal[1] * z};
}

// E/I of the tube as a line without thickness.
//   E = 2 R L int (n.r) rho/|r|^4 dt      Source: Heitz & Hill, Real-time line- and disk-light
//   shading (2017). Against a true cylinder it errs by up to 0.85 R/rho (ladder.h).
template <class T>
[[nodiscard]] T LineLuxPerCandela(const TubeSource& source, const Receiver<T>& at) {
  using S = Scalar<T>;
  const AtTube<T> m = FromAxis(at);
  const S l = static_cast<S>(source.half_length);
  if (!(m.away > S(0))) return T(0);
  return m.away *
         LineIntegral(T(-m.n_away * m.away), m.n_along, T(m.away * m.away), T(-l - m.along),
                      T(l - m.along), T(S(2) * l)) /
         (S(2) * l);
}

// One generator of the mantle, `phi` from the one nearest to the receiver.
template <class T>
[[nodiscard]] T Generator(const AtTube<T>& m, Scalar<T> l, Scalar<T> r, const T& phi) {
  using S = Scalar<T>;
  using std::cos;
  using std::sin;
  const T cosine = cos(phi);
  const T half_sine = sin(S(0.5) * phi);
  const T gap = m.away - r;
  const T away = -gap - S(2) * r * half_sine * half_sine;  // r cos(phi) - m.away
  const T rho2 = gap * gap + S(4) * r * m.away * half_sine * half_sine;
  const T toward = m.away * cosine - r;
  if (!(toward > S(0))) return T(0);
  return toward * LineIntegral(T(m.n_away * away + m.n_across * r * sin(phi)), m.n_along, rho2,
                               T(-l - m.along), T(l - m.along), T(S(2) * l));
}

// Angles between which the integrand over phi is smooth.
template <class T>
struct Bends {
  static constexpr int kMost = 128;
  std::array<T, kMost> at;
  int count = 0;

  // phi, wherever a turn brings it between +-limit; sorted in.
  void Add(const T& phi, const T& limit) {
    using S = Scalar<T>;
    constexpr S kTurn = S(2.0 * std::numbers::pi);
    for (const S turn : {-kTurn, S(0), kTurn}) {
      const T moved = phi + turn;
      if (moved > -limit && moved < limit && count < kMost - 2) Insert(moved);
    }
  }
  void Insert(const T& phi) {
    int i = count++;
    for (; i > 0 && at[i - 1] > phi; --i) at[i] = at[i - 1];
    at[i] = phi;
  }
};

// Where the horizon passes an end of the mantle, and, once it cuts the mantle, where it passes
// distances along it that grow by four from the receiver's own foot: there the cut moves fastest.
template <class T>
[[nodiscard]] Bends<T> BendsOf(const AtTube<T>& m, Scalar<T> l, Scalar<T> r, const T& limit) {
  using S = Scalar<T>;
  using std::acos;
  using std::atan2;
  using std::sqrt;
  Bends<T> out;
  out.Insert(-limit);
  out.Insert(limit);
  const T radial2 = m.n_away * m.n_away + m.n_across * m.n_across;
  if (!(radial2 > S(0))) return out;
  const T radial = sqrt(radial2);
  const T middle = atan2(m.n_across, m.n_away);
  const auto cosine_at = [&](const T& t) {  // t along the axis, from the foot
    return T((m.n_away * m.away - t * m.n_along) / (r * radial));
  };
  const auto add = [&](const T& t) {
    const T c = cosine_at(t);
    if (!(c > S(-1)) || !(c < S(1))) return;
    const T half = acos(c);
    out.Add(middle - half, limit);
    out.Add(middle + half, limit);
  };
  const T first = -l - m.along;
  const T last = l - m.along;
  const T at_first = cosine_at(first);
  const T at_last = cosine_at(last);
  if ((!(at_first < S(1)) && !(at_last < S(1))) || (!(at_first > S(-1)) && !(at_last > S(-1)))) {
    return out;
  }
  add(first);
  add(last);
  if (first < S(0) && last > S(0)) add(T(0));
  for (T step = m.away - r; step < last || step < -first; step *= S(4)) {
    if (step > first && step < last) add(step);
    if (-step > first && -step < last) add(T(-step));
  }
  return out;
}

}  // namespace models

// Axial intensity (square to the axis) I = 2 R l L, l the whole length.                 [lx/cd]
//   E/L = R int dphi (rho cos phi - R) int (n.r)/|r|^4 dt
// over the part of the mantle that both faces the receiver and stands above its horizon: the inner
// integral in closed form, the outer by Gauss-Legendre in y, phi = c sinh y, c = (rho - R)/sqrt(rho
// R), in which a near mantle is as smooth as a far one. 0 within the mantle's own cylinder; a
// radius of 0 makes it a line. Relative error below 1e-10 for (rho - R)/R from 1e-3 on, distances
// to 1e6 lengths; where the horizon leaves a sliver, 1e-14 of what the whole would give.
template <class T>
[[nodiscard]] T LuxPerCandela(const TubeSource& source, const Receiver<T>& at) {
  using S = Scalar<T>;
  using std::acos;
  using std::expm1;
  using std::log1p;
  using std::sqrt;
  using Rule = GaussLegendre<16>;
  constexpr double kPanel = 2.5;  // in y; the integrand's poles lie pi/2 off the axis
  const S l = static_cast<S>(source.half_length);
  const S r = static_cast<S>(source.radius);
  if (!(r > S(0))) return models::LineLuxPerCandela(source, at);
  const models::AtTube<T> m = models::FromAxis(at);
  if (!(m.away > r)) return T(0);
  const T limit = acos(T(r / m.away));
  const T c = (m.away - r) / sqrt(m.away * r);
  const auto asinh_of = [](const T& x) {
    const T size = x < S(0) ? T(-x) : x;
    const T y = log1p(size + size * size / (S(1) + sqrt(size * size + S(1))));
    return x < S(0) ? T(-y) : y;
  };
  const models::Bends<T> bends = models::BendsOf(m, l, r, limit);
  T sum(0);
  for (int k = 1; k < bends.count; ++k) {
    const T from = asinh_of(T(bends.at[k - 1] / c));
    const T to = asinh_of(T(bends.at[k] / c));
    int panels = 1;
    while (T(to - from) > static_cast<S>(kPanel * panels)) ++panels;
    const T half = (to - from) * (S(0.5) / static_cast<S>(panels));
    for (int p = 0; p < panels; ++p) {
      const T middle = from + half * static_cast<S>(2 * p + 1);
      for (int i = 0; i < 16; ++i) {
        const T grown = expm1(T(middle + half * static_cast<S>(Rule::kNode[i])));
        const T shrunk = grown / (grown + S(1));  // 1 - exp(-y)
        const T sinh = S(0.5) * (grown + shrunk);
        const T cosh = S(1) + S(0.5) * (grown - shrunk);
        sum += static_cast<S>(2.0 * Rule::kWeight[i]) * half * cosh *
               models::Generator(m, l, r, T(c * sinh));
      }
    }
  }
  return c * sum / (S(4) * l);
}

}  // namespace lightcal
