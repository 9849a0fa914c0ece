// SPDX-License-Identifier: Apache-2.0
// How the illuminance on the axis of an extended source departs from the inverse-square law.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "lightcal/core/units.h"
#include "lightcal/photometry/light_kind.h"

namespace lightcal {

// The outline of a Lambertian source seen from its axis, in any one unit of length.
struct AxialShape {
  enum class Outline : std::uint8_t {
    kPoint,  // also a sphere whose distance is taken from its centre: exactly inverse-square
    kDisk,   // first = radius
    kRect,   // first, second = half width, half height
    kTube,   // first = half length, seen broadside; distance from the axis
  };
  Outline outline = Outline::kPoint;
  double first = 0.0;
  double second = 0.0;
};

// Ratio of the true illuminance to I_axis / r^2 for a facing meter on the axis at distance r > 0:
//   disk   r^2 / (r^2 + R^2)
//   rect   r^2 / (2ab) [ (a/A) atan(b/A) + (b/B) atan(a/B) ], A^2 = r^2 + a^2, B^2 = r^2 + b^2
//   tube   r^2 / (2t) [ t/(r^2 + t^2) + atan(t/r)/r ]
// with R the radius, a, b half sides and t half length. Dimensionless, in (0, 1], 1 far away. A
// tilted meter sees cos(tilt) times this while no part of the source sinks below its horizon. T is
// double or an automatic-differentiation scalar. Sources: disk and rectangle, Howell's catalogue of
// configuration factors (B-12, C-11 four times); tube, the integral of a thin Lambertian cylinder
// (Heitz & Hill 2017, linear lights).
template <class T>
[[nodiscard]] T AxialShapeFactor(const AxialShape& shape, const T& r) {
  using std::atan;
  using std::sqrt;
  const double a = shape.first;
  const double b = shape.second;
  switch (shape.outline) {
    case AxialShape::Outline::kPoint:
      break;
    case AxialShape::Outline::kDisk:
      return r * r / (r * r + a * a);
    case AxialShape::Outline::kRect: {
      const T to_side_a = sqrt(r * r + a * a);
      const T to_side_b = sqrt(r * r + b * b);
      return r * r / (2.0 * a * b) *
             (a / to_side_a * atan(b / to_side_a) + b / to_side_b * atan(a / to_side_b));
    }
    case AxialShape::Outline::kTube:
      return r * r / (2.0 * a) * (a / (r * r + a * a) + atan(a / r) / r);
  }
  return T(1.0);
}

// Of g(r)/r^2, the illuminance a candela casts on the axis (g as above), by r: its value, first and
// second derivative in closed form, where automatic differentiation takes each arc tangent anew.
struct AxialFalloff {
  double value = 0.0;
  double slope = 0.0;
  double bend = 0.0;
};
[[nodiscard]] AxialFalloff AxialFalloffAt(const AxialShape& shape, double r);

// What a session says of a source's size; what a kind does not have is absent.
struct SourceSize {
  std::optional<Metres> diameter;        // sphere, disk
  std::optional<Metres> width, height;   // rect
  std::optional<Metres> length, radius;  // tube
};
// The outline of a kind of that size in metres; kPoint for kinds without one or of unknown size,
// kTube for a rect with one side of 0.
[[nodiscard]] AxialShape AxialShapeOf(LightKind kind, const SourceSize& size);

}  // namespace lightcal
