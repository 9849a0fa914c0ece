// SPDX-License-Identifier: Apache-2.0
// A source by its kind and size.
#pragma once

#include <optional>

#include "lightcal/light/axial_shape.h"
#include "lightcal/light/models/source_model.h"

namespace lightcal {

// The luminous body of that kind and size, a tube's radius 0 where it is not given; absent of kinds
// without one and where a side is not known.
[[nodiscard]] inline std::optional<SourceModel> BodyOf(LightKind kind, const SourceSize& size) {
  switch (kind) {
    case LightKind::kSphere:
      if (size.diameter) return SphereSource{0.5 * size.diameter->value()};
      break;
    case LightKind::kDisk:
      if (size.diameter) return DiskSource{0.5 * size.diameter->value()};
      break;
    case LightKind::kRect:
      if (size.width && size.height) {
        return RectSource{0.5 * size.width->value(), 0.5 * size.height->value()};
      }
      break;
    case LightKind::kTube:
      if (size.length) {
        return TubeSource{0.5 * size.length->value(), size.radius.value_or(Metres(0.0)).value()};
      }
      break;
    default:
      break;
  }
  return std::nullopt;
}

}  // namespace lightcal
