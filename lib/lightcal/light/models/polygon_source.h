// SPDX-License-Identifier: Apache-2.0
// A flat polygon of one luminance, by Lambert's contour integral or by quadrature, whichever keeps
// its digits, cut at the receiver's horizon.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "lightcal/light/models/gauss_legendre.h"
#include "lightcal/light/models/receiver.h"

namespace lightcal::models {

inline constexpr std::size_t kMostCorners = 16;

// A corner as the receiver sees it.
template <class T>
struct Corner {
  Vec3Of<T> v;  // from the receiver
  T height;     // over the receiver's horizon, n.v
  T x, y;       // in the source's plane: far away v has lost their digits
};

// Corners of a polygon, at most kMostCorners of them: one more for each side of a horizon.
template <class T>
struct Polygon {
  std::array<Corner<T>, kMostCorners + 2> corner;
  std::size_t size = 0;
  void Add(const Corner<T>& c) { corner[size++] = c; }
};

// The part above the horizon (Sutherland & Hodgman). Concave polygons may leave pieces joined along
// the horizon, which cancel in a contour integral.
template <class T>
[[nodiscard]] Polygon<T> AboveHorizon(const Polygon<T>& polygon) {
  using S = Scalar<T>;
  Polygon<T> out;
  for (std::size_t i = 0; i < polygon.size && out.size < kMostCorners; ++i) {
    const Corner<T>& a = polygon.corner[i];
    const Corner<T>& b = polygon.corner[(i + 1) % polygon.size];
    const bool a_above = a.height > S(0);
    if (a_above) out.Add(a);
    if (a_above == (b.height > S(0))) continue;
    const T t = a.height / (a.height - b.height);
    out.Add({a.v + (b.v - a.v) * t, T(0), a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t});
  }
  return out;
}

// Angle between two edges' ends times the projection of their plane's normal:
//   Theta (Gamma.n),  Theta = atan2(|a x b|, a.b), Gamma = a x b/|a x b|.
// Both a x b = a x (b - a) and a.b keep their digits for short edges; acos would lose them.
template <class T>
[[nodiscard]] T EdgeTerm(const Vec3Of<T>& a, const Vec3Of<T>& b, const Vec3Of<T>& normal) {
  using S = Scalar<T>;
  using std::atan2;
  using std::sqrt;
  const Vec3Of<T> across = Cross(a, Vec3Of<T>(b - a));
  const T length2 = Dot(across, across);
  if (!(length2 > S(0))) return T(0);
  const T length = sqrt(length2);
  return atan2(length, Dot(a, b)) * (Dot(across, normal) / length);
}

// E/L = 1/2 |sum of edge terms|. Error about 1e-16 d/size of E/L at normal incidence.
template <class T>
[[nodiscard]] T ContourLuxPerNit(const Polygon<T>& polygon, const Vec3Of<T>& normal) {
  using S = Scalar<T>;
  T sum(0);
  for (std::size_t i = 0; i < polygon.size; ++i) {
    sum += EdgeTerm(polygon.corner[i].v, polygon.corner[(i + 1) % polygon.size].v, normal);
  }
  return sum < S(0) ? S(-0.5) * sum : S(0.5) * sum;
}

// E/L of a convex polygon in a plane at height h over the receiver, as triangles from its first
// corner, N x N points each (the square folded onto the triangle).
//   E/L = int (n.v) h/|v|^4 dA
template <int N, class T>
[[nodiscard]] T FanLuxPerNit(const Polygon<T>& polygon, const T& height) {
  using S = Scalar<T>;
  T sum(0);
  for (std::size_t i = 2; i < polygon.size; ++i) {
    const Corner<T>& a = polygon.corner[0];
    const Corner<T>& b = polygon.corner[i - 1];
    const Corner<T>& c = polygon.corner[i];
    const T twice_area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    T mean(0);
    for (int p = 0; p < N; ++p) {
      const S u = static_cast<S>(0.5 + 0.5 * GaussLegendre<N>::kNode[p]);
      for (int q = 0; q < N; ++q) {
        const S w = u * static_cast<S>(0.5 + 0.5 * GaussLegendre<N>::kNode[q]);
        const Vec3Of<T> v = a.v * (S(1) - u) + b.v * (u - w) + c.v * w;
        const T above = a.height * (S(1) - u) + b.height * (u - w) + c.height * w;
        const T r2 = Dot(v, v);
        const S weight =
            static_cast<S>(GaussLegendre<N>::kWeight[p] * GaussLegendre<N>::kWeight[q]) * u;
        mean += weight * above / (r2 * r2);
      }
    }
    sum += mean * twice_area;
  }
  return sum < S(0) ? T(-sum * height) : T(sum * height);
}

}  // namespace lightcal::models

namespace lightcal {

// A flat convex polygon of luminance L in the plane z = 0, shining along +z, its corners
// {x, y} in either winding, 3 to 14 of them. Axial intensity I = L A.                 [lx/cd]
//   E = (L/2) |sum_i Theta_i (Gamma_i.n)| over the edges of the part above the receiver's horizon
// Far away (8 radii and more) Gauss-Legendre, because the contour sum cancels there. 0 behind the
// plane and where the polygon lies below the horizon.
// Source: Lambert's formula; Baum, Rushmeier & Winget, SIGGRAPH 1989, eq. 6.
template <class T>
[[nodiscard]] T PolygonLuxPerCandela(std::span<const std::array<double, 2>> corners,
                                     const Receiver<T>& at) {
  using S = Scalar<T>;
  if (!(at.position[2] > S(0)) || corners.size() < 3 || corners.size() + 2 > models::kMostCorners) {
    return T(0);
  }
  models::Polygon<T> polygon;
  double twice_area = 0.0;
  double radius2 = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& [x, y] = corners[i];
    const auto& next = corners[(i + 1) % corners.size()];
    const auto& first = corners[0];
    twice_area += (x - first[0]) * (next[1] - first[1]) - (next[0] - first[0]) * (y - first[1]);
    radius2 = std::max(radius2, x * x + y * y);
    const Vec3Of<T> v = {static_cast<S>(x) - at.position[0], static_cast<S>(y) - at.position[1],
                         -at.position[2]};
    polygon.Add({v, Dot(v, at.normal), T(static_cast<S>(x)), T(static_cast<S>(y))});
  }
  const S area = static_cast<S>(0.5 * std::abs(twice_area));
  if (!(area > S(0))) return T(0);
  const models::Polygon<T> seen = models::AboveHorizon(polygon);
  if (seen.size < 3) return T(0);
  if (Dot(at.position, at.position) > static_cast<S>(64.0 * radius2)) {
    return models::FanLuxPerNit<6>(seen, at.position[2]) / area;
  }
  return models::ContourLuxPerNit(seen, at.normal) / area;
}

}  // namespace lightcal
