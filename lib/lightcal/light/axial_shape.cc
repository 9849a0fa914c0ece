// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/axial_shape.h"

#include <algorithm>
#include <cmath>

namespace lightcal {

AxialFalloff AxialFalloffAt(const AxialShape& shape, double r) {
  const double a = shape.first;
  const double b = shape.second;
  const double rr = r * r;
  switch (shape.outline) {
    case AxialShape::Outline::kPoint:
      break;
    case AxialShape::Outline::kDisk: {
      const double q = 1.0 / (rr + a * a);
      return {q, -2.0 * r * q * q, (8.0 * rr * q - 2.0) * q * q};
    }
    case AxialShape::Outline::kRect: {
      const double per_corner = 1.0 / (rr + a * a + b * b);
      AxialFalloff sum;
      // (u/U) atan(v/U), U^2 = r^2 + u^2, and its derivatives.
      const auto add = [&](double u, double v) {
        const double q = 1.0 / (rr + u * u);
        const double root = std::sqrt(q);
        const double angle = std::atan(v * root) * root;
        const double side = v * per_corner;
        sum.value += u * angle;
        const double both = angle + side;
        sum.slope -= u * r * q * both;
        sum.bend += u * q * (rr * (3.0 * q * both + 2.0 * side * per_corner) - both);
      };
      add(a, b);
      add(b, a);
      const double per_area = 0.5 / (a * b);
      return {per_area * sum.value, per_area * sum.slope, per_area * sum.bend};
    }
    case AxialShape::Outline::kTube: {
      const double q = 1.0 / (rr + a * a);
      const double angle = std::atan(a / r) / (a * r);
      return {0.5 * (q + angle), -r * q * q - 0.5 * (q + angle) / r,
              4.0 * rr * q * q * q + (q + angle) / rr};
    }
  }
  const double q = 1.0 / rr;
  return {q, -2.0 * q / r, 6.0 * q * q};
}

AxialShape AxialShapeOf(LightKind kind, const SourceSize& size) {
  if (kind == LightKind::kDisk && size.diameter) {
    return {AxialShape::Outline::kDisk, 0.5 * size.diameter->value(), 0.0};
  }
  if (kind == LightKind::kRect && size.width && size.height) {
    const double width = size.width->value();
    const double height = size.height->value();
    // All length: its axis is a thin tube's.
    if (!(width > 0.0) || !(height > 0.0)) {
      return {AxialShape::Outline::kTube, 0.5 * std::max(width, height), 0.0};
    }
    return {AxialShape::Outline::kRect, 0.5 * width, 0.5 * height};
  }
  if (kind == LightKind::kTube && size.length) {
    return {AxialShape::Outline::kTube, 0.5 * size.length->value(), 0.0};
  }
  return {};
}

}  // namespace lightcal
