// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/axial_shape.h"

#include <algorithm>

namespace lightcal {

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
