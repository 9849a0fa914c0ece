// SPDX-License-Identifier: Apache-2.0
// A point or direction in metres: right-handed, Z up. The components are double, float or an
// automatic-differentiation scalar; products of two kinds have the kind their components' product
// has.
#pragma once

#include <array>
#include <cmath>

namespace lightcal {

template <class T>
using Vec3Of = std::array<T, 3>;
using Vec3 = Vec3Of<double>;

template <class A, class B>
[[nodiscard]] constexpr auto operator-(const Vec3Of<A>& a, const Vec3Of<B>& b)
    -> Vec3Of<decltype(a[0] - b[0])> {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class A, class B>
[[nodiscard]] constexpr auto operator+(const Vec3Of<A>& a, const Vec3Of<B>& b)
    -> Vec3Of<decltype(a[0] + b[0])> {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class A, class S>
[[nodiscard]] constexpr auto operator*(const Vec3Of<A>& a, const S& s)
    -> Vec3Of<decltype(a[0] * s)> {
  return {a[0] * s, a[1] * s, a[2] * s};
}
template <class A, class B>
[[nodiscard]] constexpr auto Dot(const Vec3Of<A>& a, const Vec3Of<B>& b) -> decltype(a[0] * b[0]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class A, class B>
[[nodiscard]] constexpr auto Cross(const Vec3Of<A>& a, const Vec3Of<B>& b)
    -> Vec3Of<decltype(a[0] * b[0])> {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] inline double Length(const Vec3& a) { return std::hypot(a[0], a[1], a[2]); }

}  // namespace lightcal
