// SPDX-License-Identifier: Apache-2.0
// A rectangle of one luminance, for a meter anywhere, turned anyhow.
#pragma once

#include <array>
#include <cmath>

#include "lightcal/light/models/line_integral.h"
#include "lightcal/light/models/point_source.h"
#include "lightcal/light/models/polygon_source.h"

namespace lightcal {

struct RectSource {
  double half_width = 0.0;   // along x
  double half_height = 0.0;  // along y
};

namespace models {

// E/I of a small flat source: cr cs/d^2, cs the cosine at the source.
template <class T>
[[nodiscard]] T FlatPointLuxPerCandela(const Receiver<T>& at) {
  const T toward = -Dot(at.normal, at.position);
  const T d2 = Dot(at.position, at.position);
  if (!(toward > Scalar<T>(0)) || !(at.position[2] > Scalar<T>(0))) return T(0);
  return toward * at.position[2] / (d2 * d2);
}

// E/I of a rectangle that is all length: a line of half length `half` along axis 0 (x) or 1 (y).
//   1/(2 half) int (n.v) h/|v|^4 dt
template <class T>
[[nodiscard]] T FlatLineLuxPerCandela(Scalar<T> half, int axis, const Receiver<T>& at) {
  using S = Scalar<T>;
  const T along = at.position[axis];
  const T across = at.position[1 - axis];
  const T h = at.position[2];
  const T n0 = -(across * at.normal[1 - axis] + h * at.normal[2]);
  return h *
         LineIntegral(n0, T(at.normal[axis]), T(across * across + h * h), T(-half - along),
                      T(half - along), T(S(2) * half)) /
         (S(2) * half);
}

// Mean of cr cs/r^2 over N x N Gauss-Legendre points. Holds while all of the rectangle stands above
// the horizon.
template <int N, class T>
[[nodiscard]] T RectMean(const RectSource& source, const Receiver<T>& at) {
  using S = Scalar<T>;
  using Rule = GaussLegendre<N>;
  const T toward = -Dot(at.normal, at.position);
  const T h2 = at.position[2] * at.position[2];
  std::array<T, N> x2;
  std::array<T, N> nx;
  for (int i = 0; i < N; ++i) {
    const S x = static_cast<S>(source.half_width * Rule::kNode[i]);
    const T dx = x - at.position[0];
    x2[i] = dx * dx + h2;
    nx[i] = x * at.normal[0] + toward;
  }
  T sum(0);
  for (int j = 0; j < N; ++j) {
    const S y = static_cast<S>(source.half_height * Rule::kNode[j]);
    const T dy = y - at.position[1];
    const T y2 = dy * dy;
    const T ny = y * at.normal[1];
    T row(0);
    for (int i = 0; i < N; ++i) {
      const T r2 = x2[i] + y2;
      row += static_cast<S>(Rule::kWeight[i]) * (nx[i] + ny) / (r2 * r2);
    }
    sum += static_cast<S>(Rule::kWeight[j]) * row;
  }
  return sum * at.position[2];
}

// Height over the horizon of the rectangle's lowest point.
template <class T>
[[nodiscard]] T LowestOfRect(const RectSource& source, const Receiver<T>& at) {
  using S = Scalar<T>;
  using std::abs;
  return -Dot(at.normal, at.position) - abs(at.normal[0]) * static_cast<S>(source.half_width) -
         abs(at.normal[1]) * static_cast<S>(source.half_height);
}

}  // namespace models

// Axial intensity I = L w h, 0 behind the plane z = 0.                                   [lx/cd]
// Lambert's contour (polygon_source.h) within 8 half diagonals of the centre, Gauss-Legendre
// beyond, where it is both cheaper and exact to rounding. A side of 0 makes it a line, two a flat
// point.
// Relative error below 1e-10 for d/half diagonal from 1e-3 to 1e6; in a sliver of it that the
// horizon leaves, 1e-15 of what the whole would give.
template <class T>
[[nodiscard]] T LuxPerCandela(const RectSource& source, const Receiver<T>& at) {
  using S = Scalar<T>;
  if (!(at.position[2] > S(0))) return T(0);
  const S a = static_cast<S>(source.half_width);
  const S b = static_cast<S>(source.half_height);
  if (!(a > S(0)) && !(b > S(0))) return models::FlatPointLuxPerCandela(at);
  if (!(a > S(0))) return models::FlatLineLuxPerCandela(b, 1, at);
  if (!(b > S(0))) return models::FlatLineLuxPerCandela(a, 0, at);
  const T d2 = Dot(at.position, at.position);
  const S size2 = a * a + b * b;
  if (d2 > S(64) * size2 && models::LowestOfRect(source, at) > S(0)) {
    return d2 > S(1e4) * size2 ? models::RectMean<4>(source, at) : models::RectMean<6>(source, at);
  }
  const std::array<std::array<double, 2>, 4> corners = {{{source.half_width, source.half_height},
                                                         {-source.half_width, source.half_height},
                                                         {-source.half_width, -source.half_height},
                                                         {source.half_width, -source.half_height}}};
  return PolygonLuxPerCandela<T>(corners, at);
}

}  // namespace lightcal
