// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/lens_bearing.h"

#include <algorithm>

namespace lightcal {

double FocalOf(const PictureView& view) {
  const double half = view.field_of_view.value() / 2.0;
  switch (view.projection) {
    case Projection::kRectilinear:
      return view.width / 2.0 / std::tan(half);
    case Projection::kEquisolid:
      return RimPixels(view) / (2.0 * std::sin(half / 2.0));
    default:
      return RimPixels(view) / half;
  }
}

Radians FieldOfViewOf(const PictureView& view, double focal_px) {
  switch (view.projection) {
    case Projection::kRectilinear:
      return Radians(2.0 * std::atan(view.width / 2.0 / focal_px));
    case Projection::kEquisolid:
      return Radians(4.0 * std::asin(std::min(1.0, RimPixels(view) / (2.0 * focal_px))));
    default:
      return Radians(2.0 * RimPixels(view) / focal_px);
  }
}

}  // namespace lightcal
