// SPDX-License-Identifier: Apache-2.0
// A disk of one luminance, for a meter anywhere, turned anyhow.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/light/models/gauss_legendre.h"
#include "lightcal/light/models/polygon_source.h"
#include "lightcal/light/models/rect_source.h"

namespace lightcal {

struct DiskSource {
  double radius = 0.0;
};

namespace models {

// int dphi {1, cos phi, sin phi}/(S + q cos phi) between two angles, S > q >= 0, D^2 = S^2 - q^2,
// m = q/(S + D):
//   {1}    (phi - 2 atan2(m sin phi, 1 + m cos phi))/D            no branch to choose
//   {cos}  (-q phi/(S + D) + 2 (S/q) atan2(..))/D
//   {sin}  -ln(S + q cos phi)/q
template <class T>
struct ArcIntegrals {
  T one, cosine, sine;
};
template <class T>
[[nodiscard]] ArcIntegrals<T> IntegrateArc(const T& s, const T& q, const T& d, const T& from,
                                           const T& to) {
  using S = Scalar<T>;
  using std::atan2;
  using std::cos;
  using std::log1p;
  using std::sin;
  const T m = q / (s + d);
  const T swing =
      atan2(m * sin(to), S(1) + m * cos(to)) - atan2(m * sin(from), S(1) + m * cos(from));
  ArcIntegrals<T> out;
  out.one = (to - from - S(2) * swing) / d;
  if (q > S(1e-9) * s) {
    out.cosine = (S(2) * s / q * swing - q * (to - from) / (s + d)) / d;
    out.sine = -log1p(q * (cos(to) - cos(from)) / (s + q * cos(from))) / q;
  } else {
    out.cosine = (sin(to) - sin(from)) / s;
    out.sine = (cos(from) - cos(to)) / s;
  }
  return out;
}

// A disk cut by the horizon. In its plane u points to where the horizon drops away, w across it.
template <class T>
struct CutDisk {
  T radius;
  T half_angle;     // of the arc above the horizon, about u
  T cu, cw;         // the centre from the receiver's foot
  T height;         // of the plane over the receiver
  T n_up, n_u;      // the receiver's normal along the plane's and along u
  T center_height;  // of the centre over the horizon
};

// E/L by the contour: the arc in closed form, the chord as an edge.
template <class T>
[[nodiscard]] T ContourLuxPerNit(const CutDisk<T>& disk) {
  using S = Scalar<T>;
  using std::atan2;
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T a2 = disk.cu * disk.cu + disk.cw * disk.cw;
  const T a = sqrt(a2);
  const T& r = disk.radius;
  const T h2 = disk.height * disk.height;
  const T s = h2 + a2 + r * r;
  const T d = sqrt((h2 + (a - r) * (a - r)) * (h2 + (a + r) * (a + r)));
  const T toward = a > S(0) ? T(atan2(disk.cw, disk.cu)) : T(0);  // of the centre, about u
  const T from = -disk.half_angle - toward;
  const T to = disk.half_angle - toward;
  const ArcIntegrals<T> arc = IntegrateArc(s, T(S(2) * a * r), d, from, to);
  // n along the centre's direction and across it.
  const T n_along = disk.n_u * cos(toward);
  const T n_across = -disk.n_u * sin(toward);
  const T on_arc = r * (disk.n_up * (r * arc.one + a * arc.cosine) -
                        disk.height * (n_along * arc.cosine + n_across * arc.sine));
  const T su = disk.cu + r * cos(disk.half_angle);
  const T half_chord = r * sin(disk.half_angle);
  const Vec3Of<T> first = {su, T(disk.cw + half_chord), disk.height};
  const Vec3Of<T> last = {su, T(disk.cw - half_chord), disk.height};
  const Vec3Of<T> normal = {disk.n_u, T(0), disk.n_up};
  const T sum = on_arc + EdgeTerm(first, last, normal);
  return sum < S(0) ? S(-0.5) * sum : S(0.5) * sum;
}

// The same by 16 x 6 points in s = R cos t and along the chords: for receivers far away.
template <class T>
[[nodiscard]] T MeanLuxPerNit(const CutDisk<T>& disk) {
  using S = Scalar<T>;
  using std::cos;
  using std::sin;
  using Angles = GaussLegendre<16>;
  using Chords = GaussLegendre<6>;
  T sum(0);
  for (int i = 0; i < 16; ++i) {
    const T t = disk.half_angle * static_cast<S>(0.5 + 0.5 * Angles::kNode[i]);
    const T u = disk.radius * cos(t);
    const T half_chord = disk.radius * sin(t);
    const T above = disk.center_height + disk.n_u * u;
    const T r2_of_row = disk.height * disk.height + (disk.cu + u) * (disk.cu + u);
    T row(0);
    for (int j = 0; j < 6; ++j) {
      const T w = disk.cw + half_chord * static_cast<S>(Chords::kNode[j]);
      const T r2 = r2_of_row + w * w;
      row += static_cast<S>(Chords::kWeight[j]) / (r2 * r2);
    }
    sum += static_cast<S>(Angles::kWeight[i]) * row * above * half_chord * half_chord;
  }
  return S(2) * disk.half_angle * sum * disk.height;
}

// E/I with all of the disk above the horizon; nothing is subtracted from its like:
//   S = h^2 + a^2 + R^2, D = sqrt(S^2 - 4 a^2 R^2), q = h^2 + a^2 - R^2
//   E/L = pi (n_up F_par + n_a F_perp)
//   F_par = 2 R^2 h^2/(D (D + q)), or (1 - q/D)/2 for q <= 0;  F_perp = 2 h a R^2/(D (S + D))
template <class T>
[[nodiscard]] T WholeDiskLuxPerCandela(double radius, const Receiver<T>& at) {
  using S = Scalar<T>;
  using std::sqrt;
  const S r = static_cast<S>(radius);
  const T& h = at.position[2];
  const T a2 = at.position[0] * at.position[0] + at.position[1] * at.position[1];
  const T a = a2 > S(0) ? T(sqrt(a2)) : T(0);
  const T h2 = h * h;
  const T s = h2 + a2 + r * r;
  const T d = sqrt((h2 + (a - r) * (a - r)) * (h2 + (a + r) * (a + r)));
  const T q = h2 + (a - r) * (a + r);
  const T parallel = q > S(0) ? S(2) * h2 / (d * (d + q)) : S(0.5) * (S(1) - q / d) / (r * r);
  const T toward_center = -(at.position[0] * at.normal[0] + at.position[1] * at.normal[1]);
  return -at.normal[2] * parallel + toward_center * S(2) * h / (d * (s + d));
}

}  // namespace models

// Axial intensity I = pi R^2 L, 0 behind the plane z = 0.                                [lx/cd]
// Above the horizon the closed form (Howell's catalogue, B-13 and its companion for a normal across
// the axis, rewritten); cut by it Lambert's contour of arc and chord within 8 radii, quadrature
// beyond. Error as of RectSource.
template <class T>
[[nodiscard]] T LuxPerCandela(const DiskSource& source, const Receiver<T>& at) {
  using S = Scalar<T>;
  using std::acos;
  using std::sqrt;
  const T& h = at.position[2];
  if (!(h > S(0))) return T(0);
  const S r = static_cast<S>(source.radius);
  if (!(r > S(0))) return models::FlatPointLuxPerCandela(at);
  const T center = -Dot(at.normal, at.position);
  const T slope2 = at.normal[0] * at.normal[0] + at.normal[1] * at.normal[1];
  const T reach2 = slope2 * (r * r);
  if (center > S(0) && center * center >= reach2) {
    return models::WholeDiskLuxPerCandela(source.radius, at);
  }
  if (center * center >= reach2) return T(0);
  const T slope = sqrt(slope2);
  models::CutDisk<T> cut;
  cut.radius = T(r);
  cut.half_angle = acos(T(-center / (slope * r)));
  cut.cu = -(at.position[0] * at.normal[0] + at.position[1] * at.normal[1]) / slope;
  cut.cw = -(at.position[1] * at.normal[0] - at.position[0] * at.normal[1]) / slope;
  cut.height = h;
  cut.n_up = -at.normal[2];
  cut.n_u = slope;
  cut.center_height = center;
  const T lux_per_nit = Dot(at.position, at.position) > S(64) * r * r
                            ? models::MeanLuxPerNit(cut)
                            : models::ContourLuxPerNit(cut);
  return lux_per_nit / (S(std::numbers::pi) * r * r);
}

}  // namespace lightcal
