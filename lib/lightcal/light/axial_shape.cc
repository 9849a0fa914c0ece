// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/axial_shape.h"

namespace lightcal {

AxialShape AxialShapeOf(LightKind kind, const SourceSize& size) {
  if (kind == LightKind::kDisk && size.diameter) {
    return {AxialShape::Outline::kDisk, 0.5 * size.diameter->value(), 0.0};
  }
  if (kind == LightKind::kRect && size.width && size.height) {
    return {AxialShape::Outline::kRect, 0.5 * size.width->value(), 0.5 * size.height->value()};
  }
  if (kind == LightKind::kTube && size.length) {
    return {AxialShape::Outline::kTube, 0.5 * size.length->value(), 0.0};
  }
  return {};
}

}  // namespace lightcal
